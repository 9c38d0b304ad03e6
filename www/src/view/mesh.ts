import { BackSide, BufferAttribute, BufferGeometry, FrontSide, Mesh, MeshStandardMaterial } from 'three';
import type { Plane } from 'three';
import { token } from '../dom.ts';

export interface Triangles {
  readonly positions: Float32Array;
  readonly indices: Uint32Array;
  /** Without normals each face is shaded flat, as it is. */
  readonly normals?: Float32Array;
}

/** Triangles whose front has one colour and whose back another, so that flipped and open parts are seen. */
export function twoSidedMesh(triangles: Triangles, frontToken: string, cut: Plane[]): Mesh[] {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(triangles.positions, 3));
  geometry.setIndex(new BufferAttribute(triangles.indices, 1));
  if (triangles.normals) geometry.setAttribute('normal', new BufferAttribute(triangles.normals, 3));
  const side = (colour: string, which: typeof FrontSide | typeof BackSide, depthOffset: number): Mesh =>
    new Mesh(
      geometry,
      new MeshStandardMaterial({
        color: token(colour),
        side: which,
        roughness: 0.9,
        metalness: 0,
        flatShading: !triangles.normals,
        clippingPlanes: cut,
        polygonOffset: true,
        polygonOffsetFactor: depthOffset,
        polygonOffsetUnits: depthOffset,
      }),
    );
  // Lines on the mesh lie before it, and fronts before the backs they meet along a silhouette.
  return [side(frontToken, FrontSide, 1), side('--view-back', BackSide, 3)];
}
