/** Signed distances over a plane: their colours, and the lines along which they are equal. */
import { colourOf } from './colour.ts';
import { niceBelow } from './format.ts';
import type { PlaneMap } from './plane-map.ts';
import type { Rgb } from './ramp.ts';

/** Millimetres, negative inside. */
export type PlaneDistances = PlaneMap;

/** About so many lines from the surface to the farthest place. */
const LINES = 8;

/** The least and greatest value, and how far apart the lines are. */
export interface DistanceScale {
  readonly low: number;
  readonly high: number;
  readonly step: number;
}

export function scaleOf({ values }: PlaneDistances): DistanceScale {
  let [low, high] = [0, 0];
  for (const value of values) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  const reach = Math.max(-low, high);
  return { low, high, step: reach > 0 ? niceBelow((1.2 * reach) / LINES) : 1 };
}

/** Blue outside, rust inside, as w has it, pale at the surface; both sides fade alike. */
export function distanceColour(value: number, { low, high }: DistanceScale): Rgb {
  const reach = Math.max(-low, high) || 1;
  return colourOf(-value, { low: -reach, high: reach });
}

/** Multiples of the step between the least and the greatest value, 0 among them. */
export function levelsOf({ low, high, step }: DistanceScale): number[] {
  const levels: number[] = [];
  for (let k = Math.ceil(low / step); k * step <= high; k++) levels.push(Number((k * step).toPrecision(12)));
  return levels;
}

/** Where the map has a value: segments xyxy…, by marching squares between the samples. */
export function isoline({ counts: [columns, rows], origin, spacing, values }: PlaneDistances, level: number): number[] {
  const ends: number[] = [];
  const at = (i: number, j: number): number => values[j * columns + i] - level;
  /** Where the edge from one corner of a square to the next is crossed. */
  const cross = (i: number, j: number, side: number): void => {
    const [[ai, aj], [bi, bj]] = [CORNERS[side], CORNERS[(side + 1) % 4]];
    const [a, b] = [at(i + ai, j + aj), at(i + bi, j + bj)];
    const part = a / (a - b);
    ends.push(origin[0] + (i + ai + part * (bi - ai)) * spacing[0], origin[1] + (j + aj + part * (bj - aj)) * spacing[1]);
  };
  for (let j = 0; j + 1 < rows; j++) {
    for (let i = 0; i + 1 < columns; i++) {
      const above = CORNERS.map(([di, dj]) => at(i + di, j + dj) >= 0);
      const sides = [0, 1, 2, 3].filter((side) => above[side] !== above[(side + 1) % 4]);
      // Of four crossings, those belong together that cut off a corner below the level.
      if (sides.length === 4 && !above[0]) sides.push(sides.shift()!);
      for (const side of sides) cross(i, j, side);
    }
  }
  return ends;
}

/** Of a square, counter-clockwise. */
const CORNERS = [[0, 0], [1, 0], [1, 1], [0, 1]] as const;
