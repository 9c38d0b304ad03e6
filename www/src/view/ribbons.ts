/** All moves of a print in one drawing call: each is a ribbon that faces the camera, shaded as the rounded line it stands for. */
import { BufferGeometry, Color, DataTexture, DoubleSide, FloatType, Mesh, NearestFilter, RGBAFormat, ShaderMaterial } from 'three';
import { token } from '../dom.ts';
import { KINDS } from '../print.ts';
import type { MoveKind } from '../print.ts';
import { MOVES_IN_ROW, STRIDE } from '../segments.ts';
import type { Segments } from '../segments.ts';

/** Numbers of a texel. */
const TEXEL = 4;
/** Of the two triangles of a move. Instances of so few vertices would be slower to draw than vertices without any. */
const CORNERS = 6;
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
  /** From −1 to 1 across the line; before its start and beyond its end, in parts of how far its round ends reach. */
  varying vec3 place;

  void main() {
    int move = first + gl_VertexID / 6;
    ivec2 texel = ivec2(2 * (move % MOVES_IN_ROW), move / MOVES_IN_ROW);
    vec4 ends = texelFetch(moves, texel, 0);
    vec4 form = texelFetch(moves, texel + ivec2(1, 0), 0);
    int kind = int(form.w + 0.5);
    if ((shown >> kind & 1) == 0) {
      gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
      return;
    }
    // Two triangles: 0 1 2 and 2 1 3.
    int corner = gl_VertexID % 6;
    corner = corner > 2 ? (corner == 3 ? 2 : corner == 4 ? 1 : 3) : corner;
    float onward = float(corner & 1);
    float across = float(corner & 2) - 1.0;

    vec2 way = (ends.zw - ends.xy) * (move == last ? part : 1.0);
    vec3 centre = vec3(ends.xy + onward * way, form.x - SINK * form.w * form.z);
    vec3 along = vec3(normalize(ends.zw - ends.xy), 0.0);
    vec3 level = vec3(-along.y, along.x, 0.0);
    vec3 back = normalize(cameraPosition - centre);
    // Seen along the line there is no side: any does.
    vec3 side = cross(back, along);
    side = dot(side, side) > 1e-6 ? normalize(side) : level;
    vec3 forward = cross(side, back);
    // Half the extents, along these, of the ellipsoid that ends the line.
    vec2 radii = 0.5 * form.yz;
    float reach = length(radii * vec2(dot(side, level), side.z));
    float cap = length(radii * vec2(length(forward.xy), forward.z));
    vec3 at = centre + across * reach * side + (2.0 * onward - 1.0) * cap * forward;

    float span = length(way) * max(dot(forward, along), 1e-3) / cap;
    place = vec3(across, mix(1.0, -span - 1.0, onward), mix(-span - 1.0, 1.0, onward));
    colour = colours[kind];
    sideways = mat3(viewMatrix) * side;
    facing = mat3(viewMatrix) * cross(along, side);
    facing *= sign(facing.z);
    gl_Position = projectionMatrix * viewMatrix * vec4(at, 1.0);
  }
`;
/** Lines thinner than a pixel lose their roundness, which would only shimmer. */
const FRAGMENT = /* glsl */ `
  varying vec3 colour;
  varying vec3 sideways;
  varying vec3 facing;
  varying vec3 place;
  const vec3 LIGHT = vec3(-0.32, 0.51, 0.80);
  void main() {
    float beyond = max(0.0, max(place.y, place.z));
    float roundness = 1.0 - smoothstep(0.4, 1.4, fwidth(place.x));
    if (beyond * beyond + roundness * place.x * place.x > 1.0) discard;
    float side = place.x * 0.9 * roundness;
    vec3 normal = normalize(side * sideways + sqrt(1.0 - side * side) * normalize(facing));
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
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
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
    // Where the vertices are is known to the shader alone.
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.frustumCulled = false;
  }

  show({ first, end, part }: Range, hidden: ReadonlySet<MoveKind>): void {
    const { uniforms } = this.mesh.material;
    uniforms.first.value = first;
    uniforms.last.value = end - 1;
    uniforms.part.value = part;
    uniforms.shown.value = this.#kinds.reduce((bits, kind, place) => (hidden.has(kind) ? bits : bits | (1 << place)), 0);
    this.mesh.geometry.setDrawRange(0, CORNERS * (end - first));
    this.mesh.visible = end > first;
  }

  dispose(): void {
    this.#moves.dispose();
  }
}
