import type { BufferGeometry } from 'three';
import type { MeshArrays } from '../mesh-arrays.js';
import type { ThreeGeometry } from './module.js';

/**
 * A mesh, or points, as a geometry. Its positions are the model's own, in 32-bit floats; with `relative`, for models far from the
 * origin, they stay relative to the mesh's `origin`, where its object then belongs: `object.position.fromArray(mesh.origin)`.
 * Meshes without normals get none: `computeVertexNormals()` or `flatShading` as you like it.
 */
export function toGeometry(THREE: ThreeGeometry, mesh: MeshArrays, { relative = false }: { relative?: boolean } = {}): BufferGeometry {
  const { normals, indices } = mesh;
  const origin = relative ? undefined : mesh.origin;
  const positions = Float32Array.from(mesh.positions, (x, i) => x + (origin?.[i % 3] ?? 0));
  const geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.BufferAttribute(positions, 3));
  if (normals) geometry.setAttribute('normal', new THREE.BufferAttribute(normals.slice(), 3));
  if (indices) geometry.setIndex(new THREE.BufferAttribute(indices.slice(), 1));
  return geometry;
}
