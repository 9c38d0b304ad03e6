import type { IndexedMesh } from './formats.ts';

/** Turns models that stand along y into ones that stand along z, and scales them to millimetres. */
export function standUp(positions: Float32Array, millimetresPerUnit: number): Float32Array {
  const turned = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; i += 3) {
    turned[i] = positions[i] * millimetresPerUnit;
    turned[i + 1] = -positions[i + 2] * millimetresPerUnit;
    turned[i + 2] = positions[i + 1] * millimetresPerUnit;
  }
  return turned;
}

/** Each different position once, in order of first appearance. */
export function distinctPoints(positions: Float32Array): Float32Array {
  const seen = new Set<string>();
  const kept: number[] = [];
  for (let i = 0; i < positions.length; i += 3) {
    const point = positions.subarray(i, i + 3);
    const key = point.join(' ');
    if (seen.has(key)) continue;
    seen.add(key);
    kept.push(...point);
  }
  return new Float32Array(kept);
}

/** Unit vertex normals: the area-weighted mean of the faces around each vertex. */
export function vertexNormals({ positions, indices }: IndexedMesh): Float32Array {
  const normals = new Float32Array(positions.length);
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [3 * indices[i], 3 * indices[i + 1], 3 * indices[i + 2]];
    const u = [0, 1, 2].map((k) => positions[b + k] - positions[a + k]);
    const v = [0, 1, 2].map((k) => positions[c + k] - positions[a + k]);
    for (let k = 0; k < 3; k++) {
      const area = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
      for (const corner of [a, b, c]) normals[corner + k] += area;
    }
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let k = 0; k < 3; k++) normals[i + k] /= length;
  }
  return normals;
}

/** Only the vertices that a face uses, with the faces renumbered. */
export function withoutStrayVertices({ positions, indices }: IndexedMesh): IndexedMesh {
  const renumbered = new Map<number, number>();
  const kept: number[] = [];
  const faces = indices.map((vertex) => {
    if (!renumbered.has(vertex)) {
      renumbered.set(vertex, renumbered.size);
      kept.push(...positions.subarray(3 * vertex, 3 * vertex + 3));
    }
    return renumbered.get(vertex)!;
  });
  return { positions: new Float32Array(kept), indices: faces };
}
