/** Boxes along the axes. */
import type { Bounds } from 'fast-winding';

export type Triple = readonly [number, number, number];

/** The smallest box around points xyzxyz…; without any, one that is turned inside out. */
export function boundsOf(points: ArrayLike<number>): Bounds {
  const min: Bounds['min'] = [Infinity, Infinity, Infinity];
  const max: Bounds['max'] = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i++) {
    min[i % 3] = Math.min(min[i % 3], points[i]);
    max[i % 3] = Math.max(max[i % 3], points[i]);
  }
  return { min, max };
}

/** Extents along x, y and z. */
export function sizeOf({ min, max }: Bounds): [number, number, number] {
  return [max[0] - min[0], max[1] - min[1], max[2] - min[2]];
}

export function centreOf({ min, max }: Bounds): Triple {
  return [(min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2];
}

export function diagonal(bounds: Bounds): number {
  return Math.hypot(...sizeOf(bounds));
}
