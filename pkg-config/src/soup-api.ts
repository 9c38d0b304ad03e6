// Soups, as the package's callers see them.
import type { CheckOptions, CheckReport, FaceOrientOptions, OrientedFaces } from './check-api.js';
import type { Cloud } from './cloud-api.js';
import type { CallOptions, Mesh } from './common-api.js';
import type { HollowOptions } from './distance-api.js';
import type { Repaired, RepairOptions } from './repair-api.js';
import type { Shape } from './shape-api.js';
import type { TexturedSoup } from './texture-api.js';

/** Triangles as arrays. */
export interface SoupArrays {
  /** xyzxyz… in millimetres. */
  positions: Float32Array | Float64Array;
  /** Three for each triangle, counter-clockwise seen from outside; without them each three positions are one. */
  indices?: Uint32Array;
}

/** Triangles without any promise about how they fit together. */
export interface Soup extends Shape, TexturedSoup {
  readonly kind: 'soup';
  /** The triangles as they are. */
  geometry(): Promise<{ positions: Float32Array; indices: Uint32Array; origin: Float64Array }>;
  /** The walls along its inside, less the drains: closed and manifold. Fails with `EmptyResult` where they leave no cavity. */
  hollow(options: HollowOptions): Promise<Mesh>;
  /** Where the surface is open: two ends (xyzxyz) for each of `count` edges. */
  boundaryEdges(): Promise<{ positions: Float32Array; origin: Float64Array; count: number }>;
  /** What is wrong with it, what the winding field makes of it, and whether it will print. */
  check(options?: CheckOptions): Promise<CheckReport>;
  /**
   * Turns faces so that they run with their neighbours and face outward. Cavities stay cavities as far as that can be told. Later
   * calls are about the soup as it is then.
   */
  orient(options?: FaceOrientOptions): Promise<OrientedFaces>;
  /**
   * Points with normals and areas of the mesh: its vertices (the default), each with a third of the triangles around it, or the
   * barycentres of its triangles. What has no area or direction is left out, with a warning.
   */
  toCloud(options?: { at?: 'vertices' | 'barycentres' } & CallOptions): Promise<Cloud>;
  /** A closed manifold that bounds where w ≥ ½, with the triangles of this soup, or made anew. This soup stays as it is. */
  repair(options?: RepairOptions): Promise<Repaired<Soup>>;
}
