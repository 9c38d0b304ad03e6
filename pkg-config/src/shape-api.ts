// What soups and clouds have in common, as the package's callers see it.
import type { BooleanOperation, BooleanOptions, BooleanResult } from './boolean-api.js';
import type { Bounds, CallOptions, Mesh, Warning } from './common-api.js';
import type { Distances } from './distance-api.js';
import type { Accuracy, HeatMap, Prepared, SurfaceOptions } from './field-api.js';
import type { Layer, SliceOptions } from './slice-api.js';
import type { VoxelBricks, VoxelOptions, Voxels } from './voxels-api.js';

/** Formats of triangles that are written. */
export type SoupFormat = 'stl' | 'obj' | 'ply' | 'off' | '3mf';
/** Formats of points that are written. */
export type CloudFormat = 'ply' | 'xyz';

/** What a soup and a cloud have in common: a winding field, and questions to it. */
export interface Shape extends Distances {
  /** Triangles or points. */
  readonly kind: 'soup' | 'cloud';
  /** The file's format, `arrays`, or `field` if it was saved. */
  readonly format: string;
  /** What was put right or left out when it was read. */
  readonly warnings: Warning[];
  /** The smallest box around it. */
  readonly bounds: Bounds;
  /** Number of triangles or points. */
  readonly count: number;
  /** Gives its memory back at once; later calls fail with `Freed`. */
  free(): void;
  /** As `free`, for `using`. */
  [Symbol.dispose](): void;
  /**
   * Builds the tree ahead of time. `bounded`, for clouds, for this and all later calls: no point adds more than ½ to the winding
   * number (*Leaps and Bounds*), which stays smooth right next to noisy points; off unless asked for.
   */
  prepare(options?: Accuracy & { leafSize?: number; bounded?: boolean } & CallOptions): Promise<Prepared>;
  /** Winding numbers at `points` (xyzxyz…), one for each. */
  windingNumbers(points: Float32Array | Float64Array, options?: Accuracy & CallOptions): Promise<Float64Array>;
  /** 1 for each of `points` (xyzxyz…) that is inside, else 0. */
  contains(points: Float32Array | Float64Array, options?: CallOptions): Promise<Uint8Array>;
  /** Which cells of a lattice are inside. */
  voxelize(options?: VoxelOptions): Promise<Voxels>;
  /** The voxels of `voxelize` in bricks. Memory grows with the surface, by `continuation`, and for soups by `lattice`. */
  voxelBricks(options?: Omit<VoxelOptions, 'format'>): Promise<VoxelBricks>;
  /** Contours of layers, from the lowest up. */
  slice(options?: SliceOptions): Promise<Layer[]>;
  /** The same layers one after the other, from the first: only some are in memory at a time. */
  layers(options?: SliceOptions): AsyncIterable<Layer>;
  /** The surface where w = 1/2, closed unless it is trimmed. */
  surface(options?: SurfaceOptions): Promise<Mesh>;
  /** w over the plane at `z` millimetres, `resolution` samples along the longer side. */
  heatMap(options: { z: number; resolution?: number } & CallOptions): Promise<HeatMap>;
  /**
   * The solids of this shape and another combined: each trimmed along the other's surface, exactly, and where that is missing along the
   * level set of its field. Of closed soups the result is closed; what nothing cuts stays as it is.
   */
  boolean(operation: BooleanOperation, other: Shape, options?: BooleanOptions): Promise<BooleanResult>;
  /** The shape and its field as bytes, which `open` and `load` make shapes of that need not be built again. */
  save(options?: CallOptions): Promise<Uint8Array>;
  /** The shape as a file: `stl` (binary), `obj`, `ply`, `off` or `3mf` for soups, `ply` or `xyz` for clouds. */
  export(format: SoupFormat | CloudFormat): Promise<Uint8Array>;
}
