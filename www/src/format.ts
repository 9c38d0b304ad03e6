const integer = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });

/** A whole number with thousands separated. */
export function count(value: number): string {
  return integer.format(value);
}

/** A number with about `digits` significant figures, never in exponents for everyday sizes. */
export function significant(value: number, digits = 4): string {
  if (value === 0) return '0';
  const magnitude = Math.floor(Math.log10(Math.abs(value)));
  if (magnitude < -6 || magnitude > 12) return value.toExponential(digits - 1);
  const decimals = Math.min(8, Math.max(0, digits - 1 - magnitude));
  return new Intl.NumberFormat('en', { maximumFractionDigits: decimals }).format(value).replace('-', '−');
}

export function milliseconds(value: number): string {
  if (value < 10) return `${value.toFixed(1)} ms`;
  return value < 1000 ? `${value.toFixed(0)} ms` : `${(value / 1000).toFixed(2)} s`;
}

/** A volume given in mm³; in cm³ from 1,000 mm³ on. */
export function volume(cubicMillimetres: number): string {
  return cubicMillimetres < 1000 ? `${significant(cubicMillimetres)} mm³` : `${significant(cubicMillimetres / 1000)} cm³`;
}

/** A length given in mm; in m from 1,000 mm on. */
export function length(millimetres: number): string {
  return millimetres < 1000 ? `${significant(millimetres, 3)} mm` : `${significant(millimetres / 1000, 3)} m`;
}

/** Extents given in mm, along x, y and z. */
export function size(extents: readonly number[]): string {
  return `${extents.map((extent) => significant(extent)).join(' × ')} mm`;
}

export function mass(grams: number): string {
  return grams < 1000 ? `${significant(grams, 3)} g` : `${significant(grams / 1000, 3)} kg`;
}

/** A time that a person waits for: seconds below a minute, minutes below an hour. */
export function duration(seconds: number): string {
  if (seconds < 59.5) return `${Math.round(seconds)} s`;
  const minutes = Math.round(seconds / 60);
  return minutes < 60 ? `${minutes} min` : `${count(Math.floor(minutes / 60))} h ${minutes % 60} min`;
}

export function bytes(value: number): string {
  return value < 1e6 ? `${significant(value / 1e3, 3)} KB` : `${significant(value / 1e6, 3)} MB`;
}

export function plural(value: number, one: string, many = `${one}s`): string {
  return `${count(value)} ${value === 1 ? one : many}`;
}

/** The largest of 1, 2 and 5 times a power of ten that is not above `value`. */
export function niceBelow(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  const lead = value / power;
  return Number(((lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power).toPrecision(1));
}
