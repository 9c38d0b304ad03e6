/** All moves of a print in one drawing call: each is a ribbon that faces the camera, shaded as the rounded line it stands for. */
import { BufferAttribute, Color, DataTexture, DoubleSide, FloatType, InstancedBufferGeometry, Mesh, NearestFilter, RGBAFormat, ShaderMaterial } from 'three';
import { token } from '../dom.ts';
import { KINDS } from '../print.ts';
import type { MoveKind } from '../print.ts';
import { MOVES_IN_ROW, STRIDE } from '../segments.ts';
import type { Segments } from '../segments.ts';

/** Numbers of a texel. */
const TEXEL = 4;
/** How much lower a kind is drawn than the one before, as a part of the line's height: crossing lines would flicker else. */
const SINK = 0.02;

const VERTEX = /* glsl */ `
  uniform sampler2D moves;
  uniform int first;
  uniform int last;
  /** How much of the last move is laid. */
  uniform float part;
  uniform int shown;
  uniform vec3 colours[KINDS];
  varying vec3 colour;
  varying vec3 sideways;
  varying vec3 facing;
  varying float across;

  void main() {
    int move = first + gl_InstanceID;
    ivec2 place = ivec2(2 * (move % MOVES_IN_ROW), move / MOVES_IN_ROW);
    vec4 ends = texelFetch(moves, place, 0);
    vec4 shape = texelFetch(moves, place + ivec2(1, 0), 0);
    int kind = int(shape.w + 0.5);
    if ((shown >> kind & 1) == 0) {
      gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
      return;
    }
    vec2 end = move == last ? mix(ends.xy, ends.zw, part) : ends.zw;
    vec3 centre = vec3(mix(ends.xy, end, position.x), shape.x - SINK * shape.w * shape.z);
    vec3 along = vec3(normalize(ends.zw - ends.xy), 0.0);
    vec3 level = vec3(-along.y, along.x, 0.0);
    vec3 back = normalize(cameraPosition - centre);
    // Seen along the line there is no side: any does.
    vec3 side = cross(back, along);
    side = dot(side, side) > 1e-6 ? normalize(side) : level;
    // Half of an ellipse's extent along the side, and along the line as it is seen, for its end.
    vec2 half_size = 0.5 * shape.yz;
    float reach = length(half_size * vec2(dot(side, level), side.z));
    vec3 onwards = cross(side, back);
    float round_end = length(half_size * vec2(length(onwards.xy), onwards.z));
    vec3 at = centre + side * position.y * reach + onwards * position.z * round_end;
    colour = colours[kind];
    sideways = mat3(viewMatrix) * side;
    facing = mat3(viewMatrix) * normalize(cross(along, side));
    facing *= sign(facing.z);
    across = position.y;
    gl_Position = projectionMatrix * viewMatrix * vec4(at, 1.0);
  }
`;
/** Lines thinner than a pixel lose their roundness, which would only shimmer. */
const FRAGMENT = /* glsl */ `
  varying vec3 colour;
  varying vec3 sideways;
  varying vec3 facing;
  varying float across;
  const vec3 LIGHT = vec3(-0.32, 0.51, 0.80);
  void main() {
    float roundness = 1.0 - smoothstep(0.4, 1.4, fwidth(across));
    float side = across * 0.9 * roundness;
    vec3 normal = normalize(side * sideways + sqrt(1.0 - side * side) * facing);
    float light = max(0.0, dot(normal, LIGHT));
    gl_FragColor = vec4(colour * (0.2 + 0.95 * light), 1.0);
    #include <colorspace_fragment>
  }
`;

/** What of the moves is drawn. */
export interface Range {
  readonly first: number;
  /** One after the last. */
  readonly end: number;
  /** How much of the last. */
  readonly part: number;
}

export class Ribbons {
  readonly mesh: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  readonly #kinds: readonly MoveKind[];
  readonly #moves: DataTexture;

  constructor({ data, kinds }: Segments) {
    const texels = (MOVES_IN_ROW * STRIDE) / TEXEL;
    this.#kinds = kinds;
    this.#moves = new DataTexture(data as Float32Array<ArrayBuffer>, texels, data.length / TEXEL / texels, RGBAFormat, FloatType);
    this.#moves.magFilter = this.#moves.minFilter = NearestFilter;
    this.#moves.needsUpdate = true;
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      defines: { KINDS: kinds.length, MOVES_IN_ROW, SINK: String(SINK) },
      uniforms: {
        moves: { value: this.#moves },
        first: { value: 0 },
        last: { value: 0 },
        part: { value: 1 },
        shown: { value: 0 },
        colours: { value: kinds.map((kind) => new Color(token(KINDS[kind].token))) },
      },
      side: DoubleSide,
    });
    this.mesh = new Mesh(outline(), material);
    // Where the vertices are is known to the shader alone.
    this.mesh.frustumCulled = false;
  }

  show({ first, end, part }: Range, hidden: ReadonlySet<MoveKind>): void {
    const { uniforms } = this.mesh.material;
    uniforms.first.value = first;
    uniforms.last.value = end - 1;
    uniforms.part.value = part;
    uniforms.shown.value = this.#kinds.reduce((bits, kind, place) => (hidden.has(kind) ? bits : bits | (1 << place)), 0);
    this.mesh.geometry.instanceCount = end - first;
    this.mesh.visible = end > first;
  }

  dispose(): void {
    this.#moves.dispose();
  }
}

/**
 * A ribbon with pointed ends: (along the move, across it, beyond its end).
 *
 *       0 ------ 2
 *     4            5
 *       1 ------ 3
 */
function outline(): InstancedBufferGeometry {
  const geometry = new InstancedBufferGeometry();
  const corners = new Float32Array([0, 1, 0, 0, -1, 0, 1, 1, 0, 1, -1, 0, 0, 0, -1, 1, 0, 1]);
  geometry.setAttribute('position', new BufferAttribute(corners, 3));
  geometry.setIndex([0, 1, 2, 2, 1, 3, 0, 4, 1, 2, 3, 5]);
  return geometry;
}
