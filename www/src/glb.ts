/** Textured triangles as binary glTF. */
import { boundsOf, centreOf } from './bounds.ts';
import type { Encoded } from './picture.ts';
import type { TexturedGeometry } from 'fast-winding';

/** glTF is in metres with y up; the model in millimetres with z up. */
const METRES = 0.001;
const UPRIGHT: [number, number, number, number] = [-Math.SQRT1_2, 0, 0, Math.SQRT1_2];

/** A scene of one mesh with one material. The writer is loaded when it is first asked for. */
export async function glbOf(soup: TexturedGeometry, picture: Encoded, name: string): Promise<Uint8Array> {
  const { Document, WebIO } = await import('@gltf-transform/core');
  const document = new Document();
  document.getRoot().getAsset().generator = 'fast-winding';
  const buffer = document.createBuffer();
  const { origin, positions, normals, uvs } = corners(soup);
  const attribute = (values: Float32Array, type: 'VEC2' | 'VEC3') =>
    document.createAccessor().setType(type).setArray(values as Float32Array<ArrayBuffer>).setBuffer(buffer);
  const texture = document.createTexture(name).setImage(picture.bytes as Uint8Array<ArrayBuffer>).setMimeType(picture.type);
  const material = document.createMaterial(name).setBaseColorTexture(texture).setMetallicFactor(0).setRoughnessFactor(0.9).setDoubleSided(true);
  const primitive = document
    .createPrimitive()
    .setAttribute('POSITION', attribute(positions, 'VEC3'))
    .setAttribute('NORMAL', attribute(normals, 'VEC3'))
    .setAttribute('TEXCOORD_0', attribute(uvs, 'VEC2'))
    .setMaterial(material);
  const node = document
    .createNode(name)
    .setMesh(document.createMesh(name).addPrimitive(primitive))
    .setRotation(UPRIGHT)
    .setScale([METRES, METRES, METRES])
    .setTranslation([METRES * origin[0], METRES * origin[2], -METRES * origin[1]]);
  document.getRoot().setDefaultScene(document.createScene(name).addChild(node));
  return new WebIO().writeBinary(document);
}

/** Three vertices a triangle, as each corner has coordinates of its own; relative to the middle, as glTF has single precision. */
function corners({ positions, indices, uvs }: TexturedGeometry): { origin: readonly number[]; positions: Float32Array; normals: Float32Array; uvs: Float32Array } {
  const origin = positions.length > 0 ? centreOf(boundsOf(positions)) : [0, 0, 0];
  const own = new Float32Array(3 * indices.length);
  const normals = new Float32Array(3 * indices.length);
  indices.forEach((vertex, k) => {
    for (let axis = 0; axis < 3; axis++) own[3 * k + axis] = positions[3 * vertex + axis] - origin[axis];
  });
  for (let t = 0; t < own.length; t += 9) {
    const normal = normalOf(own.subarray(t, t + 9));
    for (let k = 0; k < 3; k++) normals.set(normal, t + 3 * k);
  }
  // Pictures of glTF have their first row at v = 0.
  return { origin, positions: own, normals, uvs: uvs.map((value, k) => (k % 2 ? 1 - value : value)) };
}

/** Of unit length; up for a triangle without an area, as glTF has no zero normals. */
function normalOf(triangle: Float32Array): number[] {
  const [u, v] = [3, 6].map((start) => [0, 1, 2].map((k) => triangle[start + k] - triangle[k]));
  const normal = [0, 1, 2].map((k) => u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
  const size = Math.hypot(...normal);
  return size > 0 ? normal.map((value) => value / size) : [0, 0, 1];
}
