import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, MeshStandardMaterial } from 'three';
import type { Plane } from 'three';
import { token } from '../dom.ts';

export interface Triangles {
  readonly positions: Float32Array;
  readonly indices: Uint32Array;
  /** Without normals each face is shaded flat, as it is. */
  readonly normals?: Float32Array;
}

/** Backs that are seen this aslant, as a cosine, are the far side of a silhouette, where they would draw a line around what is closed. */
const SILHOUETTE = 0.2;
const COLOUR_OF_BACKS = /* glsl */ `
  vec3 facing = normalize(cross(dFdx(vViewPosition), dFdy(vViewPosition)));
  if (!gl_FrontFacing && abs(dot(facing, normalize(vViewPosition))) > ${SILHOUETTE}) diffuseColor.rgb = back;
`;

/** Triangles whose front has one colour and whose back another, so that flipped and open parts are seen; in one pass for both. */
export function twoSidedMesh(triangles: Triangles, frontToken: string, cut: Plane[]): Mesh[] {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(triangles.positions, 3));
  geometry.setIndex(new BufferAttribute(triangles.indices, 1));
  if (triangles.normals) geometry.setAttribute('normal', new BufferAttribute(triangles.normals, 3));
  const material = new MeshStandardMaterial({
    color: token(frontToken),
    side: DoubleSide,
    roughness: 0.9,
    metalness: 0,
    flatShading: !triangles.normals,
    clippingPlanes: cut,
    // Lines on the mesh lie before it.
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
  const back = new Color(token('--view-back'));
  material.onBeforeCompile = (shader) => {
    shader.uniforms.back = { value: back };
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nuniform vec3 back;')
      .replace('#include <color_fragment>', `#include <color_fragment>\n${COLOUR_OF_BACKS}`);
  };
  return [new Mesh(geometry, material)];
}
