/** Where on a model the parts lie that a check names: gathered to places that hang together, each to be looked at by itself. */
import type { Bounds } from 'fast-winding';
import { boundsOf } from './bounds.ts';
import type { Triple } from './bounds.ts';
import { Forest } from './forest.ts';
import type { Geometry } from './state.ts';

/** Faces and vertices by their numbers; edges and pairs of faces as two numbers each. */
export interface Named {
  readonly faces?: Uint32Array;
  /** Whether these look into the solid. */
  readonly areTurned?: boolean;
  readonly pairs?: Uint32Array;
  readonly edges?: Uint32Array;
  readonly vertices?: Uint32Array;
  readonly loops?: readonly { readonly vertices: Uint32Array; readonly isClosed: boolean }[];
  readonly boxes?: readonly Bounds[];
}

/** Triangles in the scene. */
export type Located = Pick<Geometry, 'positions' | 'indices' | 'origin'>;

/** All relative to the scene's origin. */
export interface Place {
  readonly min: Triple;
  readonly max: Triple;
  /** Faces by number. */
  readonly faces: readonly number[];
  /** Ends of segments, xyzxyz…. */
  readonly lines: readonly number[];
  /** xyz…. */
  readonly points: readonly number[];
  /** From where it can be seen, if that is known: a vector of any length. */
  readonly facing?: readonly number[];
}

/** The places of what is named, the largest first; holes face away from the middle of the model. */
export function placesOf(named: Named, { positions, indices, origin }: Located, middle: readonly number[]): Place[] {
  const point = (vertex: number): number[] => [...positions.subarray(3 * vertex, 3 * vertex + 3)];
  const cornersOf = (face: number): number[] => [...indices!.subarray(3 * face, 3 * face + 3)];
  const line = (a: number, b: number): number[] => [...point(a), ...point(b)];
  const ofFaces = (faces: number[]): Place => {
    const corners = faces.map((face) => cornersOf(face).map(point));
    const facing = mostly(corners.map(areaVector));
    return place({ faces, around: corners.flat(2), facing: named.areTurned ? facing?.map((value) => -value) : facing });
  };

  const places: Place[] = [];
  if (named.faces) places.push(...together([...named.faces].map(cornersOf), point).map((group) => ofFaces(group.map((k) => named.faces![k]))));
  if (named.pairs) {
    const pairs = couples(named.pairs);
    const groups = together(pairs.map((pair) => pair.flatMap(cornersOf)), point);
    places.push(...groups.map((group) => ofFaces([...new Set(group.flatMap((k) => pairs[k]))])));
  }
  if (named.edges) {
    const edges = couples(named.edges);
    places.push(...together(edges, point).map((group) => place({ lines: group.flatMap((k) => line(...edges[k])) })));
  }
  for (const { vertices, isClosed } of named.loops ?? []) {
    const ends = [...vertices].slice(0, isClosed ? undefined : -1);
    const corners = [...vertices].map(point);
    places.push(place({ lines: ends.flatMap((vertex, k) => line(vertex, vertices[(k + 1) % vertices.length])), facing: away(areaVector(corners), corners[0], middle) }));
  }
  for (const vertex of named.vertices ?? []) places.push(place({ points: point(vertex) }));
  for (const { min, max } of named.boxes ?? []) places.push(place({ lines: frame(min, max).map((value, i) => value - origin[i % 3]) }));
  return places;
}

type Parts = Partial<Record<'faces' | 'lines' | 'points' | 'around' | 'facing', number[]>>;

function place({ faces = [], lines = [], points = [], around = [...lines, ...points], facing }: Parts): Place {
  return { ...boundsOf(around), faces, lines, points, facing };
}

/** Twice the area that a ring of points encloses, along its normal. */
function areaVector(ring: readonly (readonly number[])[]): number[] {
  const sum = [0, 0, 0];
  ring.forEach((a, k) => {
    const [u, v] = [a, ring[(k + 1) % ring.length]].map((p) => p.map((value, axis) => value - ring[0][axis]));
    for (const axis of [0, 1, 2]) sum[axis] += u[(axis + 1) % 3] * v[(axis + 2) % 3] - u[(axis + 2) % 3] * v[(axis + 1) % 3];
  });
  return sum;
}

/** The sum of vectors, unless they cancel one another. */
function mostly(vectors: readonly number[][]): number[] | undefined {
  const sum = [0, 1, 2].map((axis) => vectors.reduce((total, vector) => total + vector[axis], 0));
  const most = vectors.reduce((total, vector) => total + Math.hypot(...vector), 0);
  return Math.hypot(...sum) > 0.3 * most ? sum : undefined;
}

/** A vector at a place, or its opposite, so that it leads away from the middle. */
function away(vector: number[], at: readonly number[], middle: readonly number[]): number[] | undefined {
  const along = vector.reduce((sum, value, k) => sum + value * (at[k] - middle[k]), 0);
  return Math.hypot(...vector) === 0 ? undefined : vector.map((value) => (along < 0 ? -value : value));
}

function couples(list: Uint32Array): [number, number][] {
  return Array.from({ length: list.length / 2 }, (_, k) => [list[2 * k], list[2 * k + 1]]);
}

/** Groups of things that share corners, which are the same where their coordinates are; the largest group first. */
function together(things: readonly (readonly number[])[], point: (vertex: number) => number[]): number[][] {
  const forest = new Forest(things.length);
  const owners = new Map<string, number>();
  things.forEach((vertices, k) => {
    for (const vertex of vertices) {
      const key = point(vertex).join(' ');
      const owner = owners.get(key);
      if (owner === undefined) owners.set(key, k);
      else forest.join(owner, k);
    }
  });
  return forest.groups().sort((a, b) => b.length - a.length);
}

/** The twelve edges of a box. */
function frame(min: readonly number[], max: readonly number[]): number[] {
  const corner = (bits: number): number[] => [0, 1, 2].map((k) => (bits & (1 << k) ? max[k] : min[k]));
  const ends: number[] = [];
  for (let bits = 0; bits < 8; bits++) {
    for (const axis of [1, 2, 4]) if (!(bits & axis)) ends.push(...corner(bits), ...corner(bits | axis));
  }
  return ends;
}
