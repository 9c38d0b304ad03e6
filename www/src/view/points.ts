import { BufferAttribute, BufferGeometry, Color, Points, ShaderMaterial, SRGBColorSpace, Vector2 } from 'three';
import type { LineSegments, Plane } from 'three';
import { token } from '../dom.ts';
import { thinLines } from './lines.ts';

/** Length of a drawn normal, as a part of the model's diagonal. */
const NORMAL_LENGTH = 0.012;
/** More normals than this are a fur that hides the points. */
const NORMALS_DRAWN = 12_000;
/** Diameter of a drawn point over the mean spacing of points on the diagonal's square: overlapping, and clearly apart. */
const COVERING = 1.7;
const APART = 0.6;
/** Cosine above which a point still counts as seen from the front: discs at a silhouette stand out behind it. */
const GRAZING = -0.3;

const VERTEX = /* glsl */ `
  #include <clipping_planes_pars_vertex>
  uniform float diameter;
  uniform float viewHeight;
  uniform vec2 depths;
  varying float facing;
  varying float depth;
  varying vec3 tint;
  void main() {
    #ifdef USE_COLOR
      tint = color;
    #else
      tint = vec3(0.0);
    #endif
    vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
    #include <clipping_planes_vertex>
    facing = HAS_NORMALS ? dot(normalize(normalMatrix * normal), normalize(-mvPosition.xyz)) : 0.0;
    depth = clamp((-mvPosition.z - depths.x) / (depths.y - depths.x), 0.0, 1.0);
    gl_Position = projectionMatrix * mvPosition;
    // A line through the points lies before their discs.
    vec4 behind = projectionMatrix * (mvPosition - vec4(0.0, 0.0, diameter, 0.0));
    gl_Position.z = behind.z * gl_Position.w / behind.w;
    gl_PointSize = max(2.0, diameter * projectionMatrix[1][1] * viewHeight / (2.0 * gl_Position.w));
  }
`;
/** With normals a point is shaded as a piece of surface; without, as a small ball, paler the farther away it is. */
const FRAGMENT = /* glsl */ `
  #include <clipping_planes_pars_fragment>
  uniform vec3 front;
  uniform vec3 back;
  uniform vec3 paper;
  varying float facing;
  varying float depth;
  varying vec3 tint;
  void main() {
    #include <clipping_planes_fragment>
    float radius = 2.0 * length(gl_PointCoord - 0.5);
    if (radius > 1.0) discard;
    vec3 surface = facing >= GRAZING ? front * (0.35 + 0.75 * max(facing, 0.0)) : back * (0.45 - 0.45 * facing);
    vec3 ball = mix(front * (0.45 + 0.55 * sqrt(1.0 - radius * radius)), paper, 0.6 * depth);
    // Round all the same, but not so dark that the scale of colours would not hold.
    vec3 measured = tint * (0.8 + 0.2 * sqrt(1.0 - radius * radius));
    gl_FragColor = vec4(HAS_TINTS ? measured : HAS_NORMALS ? surface : ball, 1.0);
    #include <colorspace_fragment>
  }
`;

/** What is known of points. */
export interface Cloud {
  readonly positions: Float32Array;
  readonly normals?: Float32Array;
  /** Red, green and blue of each, as the screen shows them. */
  readonly tints?: Uint8Array;
}

/** Round points, shaded by their normals where there are some; those seen from behind have the tint of back faces. Their own
 * tints take the place of both. */
export function pointsOf({ positions, normals, tints }: Cloud, diagonal: number, cut: Plane[]): Points {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  if (normals) geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  if (tints) geometry.setAttribute('color', new BufferAttribute(linear(tints), 3));
  geometry.computeBoundingSphere();
  const spacing = diagonal / Math.sqrt(Math.max(1, positions.length / 3));
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    defines: { HAS_NORMALS: normals ? 'true' : 'false', HAS_TINTS: tints ? 'true' : 'false', GRAZING: String(GRAZING) },
    uniforms: {
      diameter: { value: spacing * (normals ? COVERING : APART) },
      viewHeight: { value: 1 },
      depths: { value: new Vector2(0, 1) },
      front: { value: new Color(token(normals ? '--view-front' : '--view-points')) },
      back: { value: new Color(token('--view-back')) },
      paper: { value: new Color(token('--paper')) },
    },
    vertexColors: tints !== undefined,
    clipping: true,
    clippingPlanes: cut,
  });
  const points = new Points(geometry, material);
  points.onBeforeRender = (renderer, _scene, camera) => {
    const { center, radius } = geometry.boundingSphere!;
    const distance = center.clone().applyMatrix4(camera.matrixWorldInverse).z * -1;
    material.uniforms.viewHeight.value = renderer.domElement.height;
    (material.uniforms.depths.value as Vector2).set(distance - radius, distance + radius);
    material.uniformsNeedUpdate = true;
  };
  return points;
}

/** The same colours as the shader computes with them. */
function linear(tints: Uint8Array): Float32Array {
  const colour = new Color();
  const result = new Float32Array(tints.length);
  for (let i = 0; i < tints.length; i += 3) {
    colour.setRGB(tints[i] / 255, tints[i + 1] / 255, tints[i + 2] / 255, SRGBColorSpace).toArray(result, i);
  }
  return result;
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
