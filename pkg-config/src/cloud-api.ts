// Clouds, as the package's callers see them.
import type { CallOptions } from './common-api.js';
import type { RemeshOptions, Repaired } from './repair-api.js';
import type { Shape } from './shape-api.js';
import type { Soup } from './soup-api.js';

/** Points as arrays. */
export interface CloudArrays {
  /** xyzxyz… in millimetres. */
  points: Float32Array | Float64Array;
  /** xyzxyz…, outward; any length but zero. */
  normals?: Float32Array | Float64Array;
  /** Square millimetres, one for each point; estimated where missing. */
  areas?: Float32Array | Float64Array;
}

export interface OrientOptions extends CallOptions {
  /**
   * `consistency` (the default) seeks the normals whose winding number is ½ at every point (Lin et al. 2024); `stochastic` those
   * that make it 0 or 1 everywhere else (the sGCNO of *Leaps and Bounds*), some twenty times slower, better where noise is strong
   * and points are few; `propagation` fits planes to neighbours and turns one after the other, faster, but thin or sparse parts
   * may come out inverted.
   */
  method?: 'consistency' | 'stochastic' | 'propagation';
  /** Of `consistency`: 0 to 5, estimated unless given. Higher smooths more. */
  noiseLevel?: number;
  /** Sees the normals (xyzxyz…, some may be 0) some times a second while `consistency` lets them settle. */
  onNormals?: (normals: Float32Array) => void;
}

/** Points, perhaps with normals and areas. */
export interface Cloud extends Shape {
  readonly kind: 'cloud';
  /** Whether each point has a normal, given or found. */
  readonly hasNormals: boolean;
  /** Whether each point has an area, given or estimated. */
  readonly hasAreas: boolean;
  /** Gives points without normals outward ones, and areas. */
  orient(options?: OrientOptions): Promise<void>;
  /** Noise around each point, in millimetres: how far it and its neighbours are from a smooth surface, root mean square. */
  noise(options?: CallOptions): Promise<Float64Array>;
  /** A closed manifold that bounds where w ≥ ½. */
  repair(options?: RemeshOptions): Promise<Repaired<Soup>>;
  /** The points as they are; areas in square millimetres. */
  geometry(): Promise<{
    positions: Float32Array;
    normals?: Float32Array;
    areas?: Float64Array;
    origin: Float64Array;
  }>;
}
