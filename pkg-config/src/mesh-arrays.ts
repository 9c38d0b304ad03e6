/** What `surface`, `offset` and the like give, and `geometry` of soups and clouds, or arrays of your own. */
export interface MeshArrays {
  /** xyzxyz…, relative to `origin`. */
  positions: Float32Array | Float64Array;
  /** One unit vector for each position. */
  normals?: Float32Array;
  /** Three for each triangle; without them each three positions are one. */
  indices?: Uint32Array;
  /** Three numbers to add to positions; zero unless given. */
  origin?: ArrayLike<number>;
}
