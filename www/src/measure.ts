/** Colours for a quantity of each point, such as its area: pale where it is small, dark where it is large. */
import { between } from './ramp.ts';
import type { Rgb } from './ramp.ts';

/** Evenly spaced; lightness falls evenly. */
const STOPS: readonly Rgb[] = [
  [238, 230, 206],
  [240, 187, 120],
  [222, 120, 84],
  [170, 60, 96],
  [86, 28, 94],
];

/** The values between which the colours run. */
export interface Range {
  readonly low: number;
  readonly high: number;
}

/** Shares of the values that the ends of the range leave beyond them: a few outliers would make all others look the same. */
const BEYOND = 0.02;
/** Values looked at to find the range. */
const LOOKED_AT = 20_000;

export function rangeOf(values: Float64Array): Range {
  const step = Math.max(1, Math.floor(values.length / LOOKED_AT));
  const sorted = values.filter((_, i) => i % step === 0).sort();
  const at = (share: number): number => sorted[Math.round(share * (sorted.length - 1))] ?? 0;
  const [low, high] = [at(BEYOND), at(1 - BEYOND)];
  return { low, high: high > low ? high : low + (Math.abs(low) || 1) };
}

/** Red, green and blue from 0 to 255. */
export function shadeOf(value: number, { low, high }: Range): Rgb {
  return between(STOPS, (value - low) / (high - low));
}

/** Colours of all points, as the graphics card takes them. */
export function shadesOf(values: Float64Array): Uint8Array {
  const range = rangeOf(values);
  const shades = new Uint8Array(3 * values.length);
  values.forEach((value, i) => shades.set(shadeOf(value, range).map(Math.round), 3 * i));
  return shades;
}
