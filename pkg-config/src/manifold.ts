// Interop with manifold-3d: its meshes, of which no more is asked than their arrays.
import type { SoupArrays } from './api.js';
import { WindingError } from './error.js';
import type { MeshArrays } from './mesh-arrays.js';

export type { MeshArrays };

/** A mesh of manifold-3d (`Manifold.getMesh()`), or what `new Mesh(…)` takes. */
export interface ManifoldMesh {
  /** Numbers for each vertex, 3 at least: the first are x, y and z. */
  numProp: number;
  vertProperties: Float32Array;
  /** Three for each triangle, counter-clockwise seen from outside. */
  triVerts: Uint32Array;
  /** Vertices that are one with those in `mergeToVert`, though other properties differ. */
  mergeFromVert?: Uint32Array;
  mergeToVert?: Uint32Array;
}

/**
 * Triangles of a mesh of manifold-3d for `Soup.from`, its vertices merged as it says, other properties left out. The arrays are new
 * ones and may be transferred.
 */
export function soupArrays({ numProp, vertProperties, triVerts, mergeFromVert, mergeToVert }: ManifoldMesh): SoupArrays {
  if (!Number.isInteger(numProp) || numProp < 3) throw new WindingError('InvalidArgument', `numProp is ${numProp}: a whole number from 3 is needed`);
  const count = Math.floor(vertProperties.length / numProp);
  const positions = new Float32Array(3 * count);
  for (let i = 0; i < count; i++) positions.set(vertProperties.subarray(numProp * i, numProp * i + 3), 3 * i);
  if (!mergeFromVert?.length || !mergeToVert) return { positions, indices: triVerts.slice() };
  const merged = Uint32Array.from({ length: count }, (_, i) => i);
  mergeFromVert.forEach((from, i) => (merged[from] = mergeToVert[i]!));
  // What is no vertex stays as it is: the soup refuses it by name.
  return { positions, indices: triVerts.map((vertex) => merged[vertex] ?? vertex) };
}

/**
 * Triangles as manifold-3d takes them: `new Manifold(new Mesh(manifoldMesh(await soup.geometry())))`. Vertices in the same place are
 * merged, so that loose triangles, as STL has them, hang together. It fails there unless they are closed and manifold: repair them first.
 */
export function manifoldMesh({ positions, indices, origin }: MeshArrays): Required<ManifoldMesh> {
  // Without −0, which is in the same place as 0.
  const vertProperties = Float32Array.from(positions, (x, i) => x + (origin?.[i % 3] ?? 0) + 0);
  const count = Math.floor(vertProperties.length / 3);
  const triVerts = indices ? indices.slice() : Uint32Array.from({ length: count - (count % 3) }, (_, i) => i);
  const first = firstInPlace(vertProperties, count);
  const mergeFromVert = Uint32Array.from(first.keys()).filter((vertex) => first[vertex] !== vertex);
  return { numProp: 3, vertProperties, triVerts, mergeFromVert, mergeToVert: mergeFromVert.map((vertex) => first[vertex]!) };
}

const NONE = 0xffffffff;

/** For each of `count` vertices the first one in the same place, by a hash table with open addressing. */
function firstInPlace(positions: Float32Array, count: number): Uint32Array {
  const bits = new Uint32Array(positions.buffer, positions.byteOffset, 3 * count);
  const mask = 2 ** Math.ceil(Math.log2(2 * count + 1)) - 1;
  const table = new Uint32Array(mask + 1).fill(NONE);
  const isHere = (a: number, b: number) => bits[3 * a] === bits[3 * b] && bits[3 * a + 1] === bits[3 * b + 1] && bits[3 * a + 2] === bits[3 * b + 2];
  return Uint32Array.from({ length: count }, (_, vertex) => {
    let hash = 0;
    for (let axis = 0; axis < 3; axis++) {
      hash = Math.imul(hash ^ bits[3 * vertex + axis]!, 0x9e3779b1);
      hash ^= hash >>> 15;
    }
    let slot = hash & mask;
    while (table[slot] !== NONE && !isHere(table[slot]!, vertex)) slot = (slot + 1) & mask;
    if (table[slot] === NONE) table[slot] = vertex;
    return table[slot]!;
  });
}
