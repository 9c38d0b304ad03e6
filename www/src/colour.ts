/** A diverging colour map for the winding number: blue outside, pale at 1/2, rust inside. */
import { between } from './ramp.ts';
import type { Rgb } from './ramp.ts';

/** Evenly spaced from one end to the other; lightness rises to the middle and falls evenly after it. */
const STOPS: readonly Rgb[] = [
  [16, 52, 104],
  [42, 100, 158],
  [112, 161, 203],
  [186, 210, 228],
  [244, 241, 234],
  [240, 205, 173],
  [222, 145, 96],
  [186, 83, 42],
  [122, 38, 14],
];

/** The interval of w that the colours span, symmetric about 1/2. */
export interface Span {
  readonly low: number;
  readonly high: number;
}

/** From −1/2 to 3/2, so that 0 and 1 have room beyond them; wider for parts that overlap or are flipped, at most from −2 to 3. */
export function spanOf(values: Float64Array): Span {
  let reach = 0;
  for (const value of values) reach = Math.max(reach, Math.abs(value - 0.5));
  // A tenth beyond the scale is approximation, not worth a wider one.
  const half = Math.min(2.5, Math.max(1, Math.ceil(2 * (reach - 0.1)) / 2));
  return { low: 0.5 - half, high: 0.5 + half };
}

export function colourOf(value: number, { low, high }: Span): Rgb {
  return between(STOPS, (value - low) / (high - low));
}
