import { BufferAttribute, BufferGeometry, Color, Points, ShaderMaterial } from 'three';
import type { LineSegments, Plane } from 'three';
import { token } from '../dom.ts';
import { thinLines } from './lines.ts';

/** Length of a drawn normal, as a part of the model's diagonal. */
const NORMAL_LENGTH = 0.012;
/** More normals than this are a fur that hides the points. */
const NORMALS_DRAWN = 12_000;

const VERTEX = /* glsl */ `
  #include <clipping_planes_pars_vertex>
  uniform float diameter;
  uniform float viewHeight;
  varying float facing;
  void main() {
    vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
    #include <clipping_planes_vertex>
    facing = HAS_NORMALS ? dot(normalize(normalMatrix * normal), normalize(-mvPosition.xyz)) : 1.0;
    gl_Position = projectionMatrix * mvPosition;
    gl_PointSize = max(2.0, diameter * projectionMatrix[1][1] * viewHeight / (2.0 * gl_Position.w));
  }
`;
const FRAGMENT = /* glsl */ `
  #include <clipping_planes_pars_fragment>
  uniform vec3 front;
  uniform vec3 back;
  varying float facing;
  void main() {
    #include <clipping_planes_fragment>
    if (length(gl_PointCoord - 0.5) > 0.5) discard;
    gl_FragColor = vec4(facing >= 0.0 ? front * (0.35 + 0.75 * facing) : back * (0.45 - 0.45 * facing), 1.0);
    #include <colorspace_fragment>
  }
`;

/** Round points, shaded by their normals where there are some; those seen from behind have the tint of back faces. */
export function pointsOf(positions: Float32Array, normals: Float32Array | undefined, spacing: number, cut: Plane[]): Points {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  if (normals) geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    defines: { HAS_NORMALS: normals ? 'true' : 'false' },
    uniforms: {
      diameter: { value: spacing },
      viewHeight: { value: 1 },
      front: { value: new Color(token(normals ? '--view-front' : '--view-points')) },
      back: { value: new Color(token('--view-back')) },
    },
    clipping: true,
    clippingPlanes: cut,
  });
  const points = new Points(geometry, material);
  points.onBeforeRender = (renderer) => {
    material.uniforms.viewHeight.value = renderer.domElement.height;
  };
  return points;
}

/** A short line along the normal of each point, or of evenly chosen ones when there are very many. */
export function normalsOf(positions: Float32Array, normals: Float32Array, diagonal: number, cut: Plane[]): LineSegments {
  const count = positions.length / 3;
  const stride = Math.ceil(count / NORMALS_DRAWN);
  const ends = new Float32Array(6 * Math.ceil(count / stride));
  for (let i = 0, at = 0; i < count; i += stride, at += 6) {
    for (let k = 0; k < 3; k++) {
      ends[at + k] = positions[3 * i + k];
      ends[at + 3 + k] = positions[3 * i + k] + NORMAL_LENGTH * diagonal * normals[3 * i + k];
    }
  }
  return thinLines(ends, '--view-normals', cut);
}

/** A diameter at which the points of a closed surface about cover it. */
export function pointSpacing(count: number, diagonal: number): number {
  return (1.1 * diagonal) / Math.sqrt(Math.max(1, count));
}
