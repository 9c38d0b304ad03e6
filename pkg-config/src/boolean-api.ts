// Booleans, as the package's callers see them.
import type { CallOptions, Warning } from './common-api.js';
import type { Soup } from './soup-api.js';

/** What is kept of two shapes: all, what is in both, or what is in the first alone. */
export type BooleanOperation = 'union' | 'intersection' | 'difference';

export interface BooleanOptions extends CallOptions {
  /** Moves the other shape first: a 4 × 4 matrix of 16 numbers, column by column, as three.js has it in `Matrix4.elements`. */
  transform?: readonly number[] | Float64Array | Float32Array;
  /**
   * Longest step, in millimetres, of a cut along the level set of an open shape, where its triangles are missing. Unless it is given, a
   * 256th of the smaller shape's diagonal.
   */
  tolerance?: number;
  /** Cells along the longest side of a cloud, whose surface w = ½ is traced first. Unless it is given, as its points are spaced. */
  resolution?: number;
}

/** `S` is the entry's own class of soups. */
export interface BooleanResult<S = Soup> {
  /** The result, exact to rounding and ready for more; `null` if nothing is left, of which a warning tells. */
  soup: S | null;
  /** For each of its triangles, the triangle it is or is a piece of: of a cloud's traced surface where the operand is a cloud. */
  faces: Uint32Array;
  /** For each of its triangles, the operand that one is of: 0 for the shape that was asked, 1 for the other. */
  operands: Uint8Array;
  /** Codes such as `empty-result`, `different-scales`, `open-operands`, `self-crossing`. */
  warnings: Warning[];
}
