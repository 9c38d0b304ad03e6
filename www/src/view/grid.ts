import type { LineSegments } from 'three';
import type { Bounds } from 'fast-winding';
import { niceBelow } from '../format.ts';
import { thinLines } from './lines.ts';

/** Lines on the floor under the model, and how far apart they are. */
export interface Floor {
  readonly lines: LineSegments;
  readonly step: number;
}

export function floorUnder({ min, max }: Bounds, origin: Float64Array): Floor {
  const width = Math.max(max[0] - min[0], max[1] - min[1], (max[2] - min[2]) / 4, 1e-6);
  const step = niceBelow(width / 6);
  const from = [0, 1].map((k) => Math.floor((min[k] - 2 * step) / step));
  const to = [0, 1].map((k) => Math.ceil((max[k] + 2 * step) / step));
  const ends: number[] = [];
  const z = min[2] - origin[2];
  const [x, y] = [(i: number) => i * step - origin[0], (j: number) => j * step - origin[1]];
  for (let i = from[0]; i <= to[0]; i++) ends.push(x(i), y(from[1]), z, x(i), y(to[1]), z);
  for (let j = from[1]; j <= to[1]; j++) ends.push(x(from[0]), y(j), z, x(to[0]), y(j), z);
  return { lines: thinLines(new Float32Array(ends), '--view-grid'), step };
}
