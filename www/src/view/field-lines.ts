/** Field lines from a soup to its proxy, along which something may run. */
import { BufferAttribute, BufferGeometry, Color, LineSegments, ShaderMaterial } from 'three';
import type { FieldLines } from 'fast-winding';
import { token } from '../dom.ts';
import type { Surroundings } from './part.ts';

/** When all lines are drawn to their ends; one round takes so long, from 0. */
export const ROUND = 1.5;

const VERTEX = /* glsl */ `
  #include <clipping_planes_pars_vertex>
  attribute float along;
  varying float place;
  void main() {
    place = along;
    vec4 mvPosition = modelViewMatrix * vec4(position, 1.0);
    #include <clipping_planes_vertex>
    gl_Position = projectionMatrix * mvPosition;
  }
`;
/** Drawn as far as the time, brightest where it is; the rest is faint. */
const FRAGMENT = /* glsl */ `
  #include <clipping_planes_pars_fragment>
  uniform vec3 colour;
  uniform vec3 head;
  uniform float time;
  varying float place;
  void main() {
    #include <clipping_planes_fragment>
    float behind = time - place;
    float fresh = behind >= 0.0 ? exp(-9.0 * behind) : 0.0;
    gl_FragColor = vec4(mix(colour, head, fresh), behind >= 0.0 ? 1.0 : 0.15);
    #include <colorspace_fragment>
  }
`;

export function fieldLines({ points, offsets }: FieldLines, { origin, cut }: Surroundings): LineSegments<BufferGeometry, ShaderMaterial> {
  const ends: number[] = [];
  const along: number[] = [];
  for (let line = 0; line + 1 < offsets.length; line++) {
    const lengths = lengthsOf(points, offsets[line], offsets[line + 1]);
    const whole = lengths.at(-1) || 1;
    for (let k = 1; k < lengths.length; k++) {
      for (const at of [k - 1, k]) {
        const point = 3 * (offsets[line] + at);
        ends.push(points[point] - origin[0], points[point + 1] - origin[1], points[point + 2] - origin[2]);
        along.push(lengths[at] / whole);
      }
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(ends), 3));
  geometry.setAttribute('along', new BufferAttribute(Float32Array.from(along), 1));
  const material = new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { colour: { value: new Color(token('--view-field')) }, head: { value: new Color(token('--view-chosen')) }, time: { value: Infinity } },
    transparent: true,
    clipping: true,
    clippingPlanes: cut,
  });
  show(material, undefined);
  const lines = new LineSegments(geometry, material);
  lines.renderOrder = 3;
  return lines;
}

/** As they are at a time, or whole. */
export function show({ uniforms }: ShaderMaterial, time: number | undefined): void {
  uniforms.time.value = time ?? 10 * ROUND;
}

/** From the first of the points to each of them. */
function lengthsOf(points: Float64Array, first: number, end: number): number[] {
  const lengths: number[] = [];
  for (let k = first; k < end; k++) {
    const step = k > first ? Math.hypot(...[0, 1, 2].map((axis) => points[3 * k + axis] - points[3 * k - 3 + axis])) : 0;
    lengths.push((lengths.at(-1) ?? 0) + step);
  }
  return lengths;
}
