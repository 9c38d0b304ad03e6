// Winding numbers, their map over a plane and the surface at one of their levels, as the package's callers see them.
import type { CallOptions } from './common-api.js';

/** How exact winding numbers are: a tolerance, or the order and opening distance of the expansion. */
export interface Accuracy {
  /** Largest error of w: 1e-3 unless said otherwise; 0 means exact to rounding. */
  tolerance?: number;
  /** Order of the expansion. */
  order?: 0 | 1 | 2;
  /** A node is expanded beyond `beta` times its radius: 2 for soups, 2.3 for clouds unless said otherwise. */
  beta?: number;
}

/** What a built tree is. */
export interface Prepared {
  /** How long it took. */
  milliseconds: number;
  /** Memory that it takes beside the shape. */
  bytes: number;
  /** How winding numbers are computed, in words. */
  method: string;
  /** Pieces of the surface that are connected. */
  components: number;
  /** Edges where the surface is open. */
  boundaryEdges: number;
  /** Triangles that close the openings. */
  caps: number;
}

/** w over a plane z = constant, a little beyond the bounds. */
export interface HeatMap {
  /** Samples along x and y. */
  counts: [number, number];
  /** The first sample. */
  origin: [number, number];
  /** Millimetres from sample to sample along x and y. */
  spacing: [number, number];
  /** Millimetres. */
  z: number;
  /** x fastest. */
  values: Float64Array;
}

export interface SurfaceOptions extends CallOptions {
  /** Cells along the longest side. Without it and `spacing` soups get 64, clouds cells as large as their points' distances allow. */
  resolution?: number;
  /** Edge of a cubic cell in millimetres. */
  spacing?: number;
  /** The surface is where w equals this: unless said otherwise 0.5 for soups, and for clouds what passes through their points. */
  level?: number;
  /** Pieces with less than this share of the largest one's area are left out: 0 keeps all. Clouds lose tiny ones unless it is said. */
  minComponent?: number;
  /** For noisy clouds: points act as Gaussians of this many mean distances between points, such as 1. */
  smoothing?: number;
  /** For open scans: surface farther from any point of the cloud than this many distances between points is left out; then it is open. */
  trim?: number;
  /** Degrees between two parts of the surface from which the edge between them is kept sharp, such as 35: 10 to 120. Without it cells cut off edges and corners. */
  sharp?: number;
}
