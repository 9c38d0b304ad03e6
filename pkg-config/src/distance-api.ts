// Distances, offset surfaces and hollow shapes, as the package's callers see them. Lengths are in millimetres.
import type { CallOptions, Mesh } from './common-api.js';

/** How distances are measured. */
export interface DistanceOptions extends CallOptions {
  /**
   * `hard` (the default) is negative where w ≥ ½, `smooth` is the distance times 1 − 2 w, which changes its sign without a jump where
   * openings are, `none` is never negative.
   */
  sign?: 'hard' | 'smooth' | 'none';
  /** Distances up to this are exact; what is farther has this distance and the right sign, and costs next to nothing. */
  band?: number;
}

/** The samples of a lattice: give one of `resolution` (cells along the longest side, 64 unless given), `spacing` and `counts`. */
export interface DistanceLatticeOptions extends DistanceOptions {
  /** Cells along the longest side: 64 unless given. */
  resolution?: number;
  /** Edge of a cubic cell. */
  spacing?: number;
  /** Samples along x, y and z. */
  counts?: [number, number, number];
  /** Grows the bounds by this on every side first. */
  padding?: number;
}

/** Sample (i, j, k) lies at `origin + spacing * (i, j, k)`. */
export interface DistanceLattice {
  /** Samples along x, y and z. */
  counts: [number, number, number];
  /** The first sample. */
  origin: [number, number, number];
  /** From sample to sample along x, y and z. */
  spacing: [number, number, number];
  /** x fastest. */
  values: Float32Array;
}

/** For each place the point of the shape that is nearest to it; NaN where a place is not finite. */
export interface ClosestPoints {
  /** Negative inside, 0 on the surface. */
  distances: Float64Array;
  /** xyzxyz… */
  points: Float64Array;
  /** The triangle, or the point of a cloud; of those equally near the first. */
  faces: Uint32Array;
  /** Three weights of the triangle's corners; 1, 0, 0 for a cloud. */
  barycentric: Float64Array;
  /** What of the triangle is nearest: 0 its face, 1 to 3 its sides ab, bc and ca, 4 to 6 its corners. */
  features: Uint8Array;
  /** Unit vectors xyzxyz… in which the signed distance rises; on the surface its normal. */
  gradients: Float64Array;
}

/** Cells of a surface: give `resolution` (cells along the longest side, 64 unless given) or `spacing`. */
interface CellOptions extends CallOptions {
  resolution?: number;
  spacing?: number;
  /** Degrees from which an edge of the surface is kept sharp, such as 35. */
  sharp?: number;
}

/** How far away the surface is, and its cells. */
export interface OffsetOptions extends CellOptions {
  /** Above 0 outside, below 0 inside. */
  distance: number;
}

/** A round hole through the wall. */
export interface Drain {
  /** A place on its axis, outside or in the wall. */
  at: [number, number, number];
  /** From there into the cavity. */
  direction: [number, number, number];
  /** At least a cell. */
  radius: number;
}

/** How thick walls are, their drains, and cells. */
export interface HollowOptions extends CellOptions {
  /** Of the walls: two cells at least. */
  thickness: number;
  /** None unless given. */
  drains?: Drain[];
}

type Points = Float32Array | Float64Array;

/** What a soup and a cloud have in common, as promises in one entry and as values in the other. */
export interface Distances {
  /** Signed distances at points (xyzxyz…), one for each: to the nearest triangle or point, negative inside. */
  signedDistance(points: Points, options?: DistanceOptions): Promise<Float64Array>;
  /** The same at all samples of a lattice over the bounds. */
  signedDistance(options?: DistanceLatticeOptions): Promise<DistanceLattice>;
  /** The nearest point of the shape to each of `points` (xyzxyz…). */
  closestPoints(points: Points, options?: CallOptions): Promise<ClosestPoints>;
  /**
   * The surface at a signed distance from the shape, closed and manifold. Outside, and √3 cells away or more, it strictly contains all
   * triangles or points. Fails with `EmptyResult` where nothing of the shape is that deep.
   */
  offset(options: OffsetOptions): Promise<Mesh>;
}

/** The same in `./sync`. */
export interface SyncDistances {
  signedDistance(points: Points, options?: DistanceOptions): Float64Array;
  signedDistance(options?: DistanceLatticeOptions): DistanceLattice;
}
