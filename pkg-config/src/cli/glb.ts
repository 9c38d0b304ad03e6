// Textured triangles as binary glTF 2.0: one mesh, one material, the picture inside.
import type { TexturedGeometry } from '../texture-api.js';

/** Types of the pictures that glTF takes, by ending. */
const PICTURES: Record<string, string> = { png: 'image/png', jpg: 'image/jpeg', jpeg: 'image/jpeg' };
export const isPicture = (ending: string): boolean => ending in PICTURES;

/** glTF is in metres with y up; the model in millimetres with z up: a quarter turn about x. */
const METRES = 0.001;
const UPRIGHT = [-Math.SQRT1_2, 0, 0, Math.SQRT1_2];
/** The standard's numbers for what buffers hold. */
const [FLOAT, VERTICES] = [5126, 34962];
const [MAGIC, VERSION, JSON_CHUNK, BINARY_CHUNK] = [0x46546c67, 2, 0x4e4f534a, 0x004e4942];

/** Three vertices for each triangle, as each corner has coordinates of its own; relative to the middle, as glTF has single precision. */
function cornersOf({ positions, indices, uvs }: TexturedGeometry) {
  const [low, high] = rangeOf(positions, 3);
  const origin = low.map((least, axis) => (least + high[axis]!) / 2);
  const corners = new Float32Array(3 * indices.length);
  indices.forEach((vertex, k) => {
    for (let axis = 0; axis < 3; axis++) corners[3 * k + axis] = positions[3 * vertex + axis]! - origin[axis]!;
  });
  const normals = new Float32Array(corners.length);
  for (let t = 0; t < corners.length; t += 9) {
    const normal = normalOf(corners.subarray(t, t + 9));
    for (let k = 0; k < 9; k++) normals[t + k] = normal[k % 3]!;
  }
  // Pictures of glTF have their first row at v = 0.
  return { origin, positions: corners, normals, uvs: uvs.map((value, k) => (k % 2 ? 1 - value : value)) };
}

/** Least and greatest of each of `size` interleaved coordinates. */
function rangeOf(values: ArrayLike<number>, size: number): [number[], number[]] {
  const low = new Array<number>(size).fill(Infinity);
  const high = new Array<number>(size).fill(-Infinity);
  for (let k = 0; k < values.length; k++) {
    low[k % size] = Math.min(low[k % size]!, values[k]!);
    high[k % size] = Math.max(high[k % size]!, values[k]!);
  }
  return [low, high];
}

/** Of unit length; up for a triangle without an area, as glTF has no zero normals. */
function normalOf(triangle: Float32Array): number[] {
  const side = (corner: number) => [0, 1, 2].map((axis) => triangle[3 * corner + axis]! - triangle[axis]!);
  const [u, v] = [side(1), side(2)];
  const normal = [0, 1, 2].map((k) => u[(k + 1) % 3]! * v[(k + 2) % 3]! - u[(k + 2) % 3]! * v[(k + 1) % 3]!);
  const size = Math.hypot(...normal);
  return size > 0 ? normal.map((x) => x / size) : [0, 0, 1];
}

/** Four bytes each, as the container wants it. */
function padded(bytes: Uint8Array, filler: number): Buffer {
  const whole = Buffer.alloc(4 * Math.ceil(bytes.length / 4), filler);
  whole.set(bytes);
  return whole;
}

function container(description: object, binary: Uint8Array): Uint8Array {
  const chunks = [
    { type: JSON_CHUNK, data: padded(Buffer.from(JSON.stringify(description)), 0x20) },
    { type: BINARY_CHUNK, data: padded(binary, 0) },
  ].map(({ type, data }) => Buffer.concat([words(data.length, type), data]));
  return Buffer.concat([words(MAGIC, VERSION, 12 + chunks[0]!.length + chunks[1]!.length), ...chunks]);
}

function words(...numbers: number[]): Buffer {
  const bytes = Buffer.alloc(4 * numbers.length);
  numbers.forEach((number, k) => bytes.writeUInt32LE(number, 4 * k));
  return bytes;
}

/** A scene of the triangles with the picture on them, seen from both sides. */
export function glbOf(geometry: TexturedGeometry, picture: { bytes: Uint8Array; ending: string }, name: string): Uint8Array {
  const { origin, positions, normals, uvs } = cornersOf(geometry);
  const parts: Uint8Array[] = [...[positions, normals, uvs].map((array) => new Uint8Array(array.buffer)), picture.bytes];
  const starts = parts.map((_, k) => parts.slice(0, k).reduce((sum, part) => sum + 4 * Math.ceil(part.length / 4), 0));
  const [min, max] = rangeOf(positions, 3);
  const accessor = (bufferView: number, type: string) => ({ bufferView, componentType: FLOAT, count: positions.length / 3, type });
  const description = {
    asset: { version: '2.0', generator: 'fast-winding' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [
      {
        name,
        mesh: 0,
        rotation: UPRIGHT,
        scale: [METRES, METRES, METRES],
        translation: [METRES * origin[0]!, METRES * origin[2]!, -METRES * origin[1]!],
      },
    ],
    meshes: [{ name, primitives: [{ attributes: { POSITION: 0, NORMAL: 1, TEXCOORD_0: 2 }, material: 0 }] }],
    materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 }, metallicFactor: 0, roughnessFactor: 0.9 }, doubleSided: true }],
    textures: [{ source: 0 }],
    images: [{ bufferView: 3, mimeType: PICTURES[picture.ending] }],
    accessors: [{ ...accessor(0, 'VEC3'), min, max }, accessor(1, 'VEC3'), accessor(2, 'VEC2')],
    bufferViews: parts.map((part, k) => ({ buffer: 0, byteOffset: starts[k], byteLength: part.length, ...(k < 3 && { target: VERTICES }) })),
    buffers: [{ byteLength: starts[3]! + 4 * Math.ceil(picture.bytes.length / 4) }],
  };
  return container(description, Buffer.concat(parts.map((part) => padded(part, 0))));
}
