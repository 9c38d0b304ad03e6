/** Where a second model stands, how it is turned and how large it is. */
import type { Bounds } from 'fast-winding';
import { centreOf } from './bounds.ts';
import type { Triple } from './bounds.ts';

export interface Placement {
  /** Where the middle of its bounds is, in the model's coordinates. */
  readonly centre: Triple;
  /** Degrees about x, then y, then z, as they are in space. */
  readonly angles: Triple;
  readonly scale: number;
}

export const UNMOVED: Placement = { centre: [0, 0, 0], angles: [0, 0, 0], scale: 1 };

const RADIANS = Math.PI / 180;

/** Of the second model to where it stands: 16 numbers, column after column. */
export function matrixOf({ centre, angles, scale }: Placement, bounds: Bounds): number[] {
  const own = centreOf(bounds);
  const rows = rotation(angles).map((row) => row.map((value) => value * scale));
  const shift = rows.map((row, k) => centre[k] - row[0] * own[0] - row[1] * own[1] - row[2] * own[2]);
  return [0, 1, 2].flatMap((column) => [...rows.map((row) => row[column]), 0]).concat(shift, 1);
}

/** Rz · Ry · Rx, row by row. */
function rotation(angles: Triple): number[][] {
  const [cx, cy, cz] = angles.map((angle) => Math.cos(angle * RADIANS));
  const [sx, sy, sz] = angles.map((angle) => Math.sin(angle * RADIANS));
  return [
    [cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx],
    [sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx],
    [-sy, cy * sx, cy * cx],
  ];
}

/** A second model stays where its own coordinates put it if it meets the model there; otherwise the middles meet. */
export function firstPlacement(model: Bounds, second: Bounds): Placement {
  const meets = [0, 1, 2].every((k) => second.min[k] <= model.max[k] && second.max[k] >= model.min[k]);
  return { ...UNMOVED, centre: centreOf(meets ? second : model) };
}
