// Geometries and scenes of three.js as what `Soup.from` and `Cloud.from` take.
import type { BufferAttribute, BufferGeometry, InstancedMesh, InterleavedBufferAttribute, Matrix4, Mesh, Object3D, Points } from 'three';
import type { CloudArrays, SoupArrays } from '../api.js';
import { WindingError } from '../error.js';

/** In which frame a geometry or an object is read: its own, unless said otherwise. */
export interface ReadGeometryOptions {
  /** Of objects: in the world's frame, `matrixWorld` applied, rather than in the object's own. */
  world?: boolean;
  /** Applied last; for example the turn from three's y up to z up. */
  matrix?: Matrix4;
}

type Attribute = BufferAttribute | InterleavedBufferAttribute;
type Elements = ArrayLike<number>;
/** A geometry and the matrix that places it: 16 numbers, column by column. */
interface Placed {
  geometry: BufferGeometry;
  elements: Elements | undefined;
}

function positionsOf({ attributes }: BufferGeometry): Attribute {
  if (attributes.position) return attributes.position;
  throw new WindingError('InvalidArgument', 'the geometry has no attribute position');
}

/** a · b: first b, then a. */
function product(a: Elements, b: Elements): Float64Array {
  return Float64Array.from({ length: 16 }, (_, i) => {
    const [row, column] = [i % 4, i - (i % 4)];
    return a[row]! * b[column]! + a[row + 4]! * b[column + 1]! + a[row + 8]! * b[column + 2]! + a[row + 12]! * b[column + 3]!;
  });
}

/** Determinant of the part that turns, scales and mirrors. */
function determinant(m: Elements): number {
  return (
    m[0]! * (m[5]! * m[10]! - m[9]! * m[6]!) + m[4]! * (m[9]! * m[2]! - m[1]! * m[10]!) + m[8]! * (m[1]! * m[6]! - m[5]! * m[2]!)
  );
}

/** The meshes or points under an object, placed in its own frame or the world's. */
function placedUnder(root: Object3D, is: 'isMesh' | 'isPoints', { world, matrix }: ReadGeometryOptions): Placed[] {
  root.updateWorldMatrix(true, true);
  const frame = world ? undefined : root.matrixWorld.clone().invert();
  const found: Placed[] = [];
  root.traverse((object) => {
    if (!(object as Partial<Mesh & Points>)[is]) return;
    const { geometry, instanceMatrix, count } = object as InstancedMesh;
    // Of an object alone in its own frame there is nothing to apply.
    let place: Elements | undefined = object === root && !world ? undefined : object.matrixWorld.elements;
    if (place && frame) place = product(frame.elements, place);
    if (matrix) place = place ? product(matrix.elements, place) : matrix.elements;
    if (!instanceMatrix) found.push({ geometry, elements: place });
    for (let i = 0; instanceMatrix && i < count; i++) {
      const own = instanceMatrix.array.slice(16 * i, 16 * i + 16);
      found.push({ geometry, elements: place ? product(place, own) : own });
    }
  });
  return found;
}

function placed(source: BufferGeometry | Object3D, is: 'isMesh' | 'isPoints', options: ReadGeometryOptions): Placed[] {
  if (!('isBufferGeometry' in source)) return placedUnder(source as Object3D, is, options);
  if (options.world) throw new WindingError('InvalidArgument', 'a geometry has no place in the world: give the object, or its matrixWorld as matrix');
  return [{ geometry: source as BufferGeometry, elements: options.matrix?.elements }];
}

/** Coordinates as they are in the buffer, where they are plain floats. */
function plainFloats(attribute: Attribute): Float32Array | undefined {
  const { array, itemSize, normalized } = attribute;
  const isInterleaved = 'isInterleavedBufferAttribute' in attribute;
  return array instanceof Float32Array && itemSize === 3 && !normalized && !isInterleaved ? array.slice(0, 3 * attribute.count) : undefined;
}

/** Writes an attribute's vectors to `target` from `start` on, as three's shaders see them. */
function widen(attribute: Attribute, target: Float64Array, start: number): void {
  for (let i = 0; i < attribute.count; i++) {
    target[start + 3 * i] = attribute.getX(i);
    target[start + 3 * i + 1] = attribute.getY(i);
    target[start + 3 * i + 2] = attribute.getZ(i);
  }
}

/** Applies a matrix to points from `start` on; with `shift` 0, its linear part to vectors. */
function apply(m: Elements, vectors: Float64Array, start: number, shift: 0 | 1): void {
  for (let i = start; i < vectors.length; i += 3) {
    const [x, y, z] = [vectors[i]!, vectors[i + 1]!, vectors[i + 2]!];
    for (let row = 0; row < 3; row++) vectors[i + row] = m[row]! * x + m[row + 4]! * y + m[row + 8]! * z + m[row + 12]! * shift;
  }
}

/** All positions one after the other. */
function joinedPositions(parts: readonly Placed[]): Float64Array {
  const positions = new Float64Array(3 * parts.reduce((sum, { geometry }) => sum + positionsOf(geometry).count, 0));
  let start = 0;
  for (const { geometry, elements } of parts) {
    const attribute = positionsOf(geometry);
    const end = start + 3 * attribute.count;
    widen(attribute, positions, start);
    if (elements) apply(elements, positions.subarray(0, end), start, 1);
    start = end;
  }
  return positions;
}

/** Corners of a geometry's triangles, vertex 0 being `first`; turned over where a mirroring matrix would turn them inside out. */
function cornersOf({ geometry, elements }: Placed, first: number): Uint32Array {
  const { index } = geometry;
  const count = index ? index.count : positionsOf(geometry).count;
  const corners = Uint32Array.from({ length: count - (count % 3) }, (_, i) => first + (index ? index.getX(i) : i));
  if (elements && determinant(elements) < 0) {
    for (let i = 0; i < corners.length; i += 3) [corners[i + 1], corners[i + 2]] = [corners[i + 2]!, corners[i + 1]!];
  }
  return corners;
}

/**
 * Triangles of a geometry, indexed or not, or of all meshes of an object, for `Soup.from`. The arrays are new ones and may be
 * transferred. Whole geometries: neither draw ranges nor morph targets nor bones count; instances do.
 */
export function soupArrays(source: BufferGeometry | Object3D, options: ReadGeometryOptions = {}): SoupArrays {
  const parts = placed(source, 'isMesh', options);
  const [only] = parts;
  if (parts.length === 1 && !only!.elements) {
    const plain = plainFloats(positionsOf(only!.geometry));
    if (plain && only!.geometry.index) return { positions: plain, indices: cornersOf(only!, 0) };
    if (plain) return { positions: plain.slice(0, plain.length - (plain.length % 9)) };
  }
  const corners: Uint32Array[] = [];
  let first = 0;
  for (const part of parts) {
    corners.push(cornersOf(part, first));
    first += positionsOf(part.geometry).count;
  }
  const indices = new Uint32Array(corners.reduce((sum, { length }) => sum + length, 0));
  let end = 0;
  for (const some of corners) {
    indices.set(some, end);
    end += some.length;
  }
  return { positions: joinedPositions(parts), indices };
}

/** Cofactors, with the determinant's sign: what the matrix does to normals, but for their lengths. */
function normalElements(m: Elements): Float64Array {
  const sign = Math.sign(determinant(m));
  const result = new Float64Array(16);
  for (let column = 0; column < 3; column++) {
    for (let row = 0; row < 3; row++) {
      const [r, s, c, d] = [(row + 1) % 3, (row + 2) % 3, 4 * ((column + 1) % 3), 4 * ((column + 2) % 3)];
      result[4 * column + row] = sign * (m[r + c]! * m[s + d]! - m[r + d]! * m[s + c]!);
    }
  }
  return result;
}

function joinedNormals(parts: readonly Placed[]): Float64Array {
  const normals = new Float64Array(3 * parts.reduce((sum, { geometry }) => sum + positionsOf(geometry).count, 0));
  let start = 0;
  for (const { geometry, elements } of parts) {
    const end = start + 3 * positionsOf(geometry).count;
    widen(geometry.attributes.normal!, normals, start);
    if (elements) apply(normalElements(elements), normals.subarray(0, end), start, 0);
    start = end;
  }
  return normals;
}

/**
 * Vertices of a geometry, or of all `Points` of an object, for `Cloud.from`, with their normals if all have some. The arrays are new
 * ones and may be transferred.
 */
export function cloudArrays(source: BufferGeometry | Object3D, options: ReadGeometryOptions = {}): CloudArrays {
  const parts = placed(source, 'isPoints', options);
  const points = joinedPositions(parts);
  const haveNormals = parts.length > 0 && parts.every(({ geometry }) => geometry.attributes.normal !== undefined);
  return haveNormals ? { points, normals: joinedNormals(parts) } : { points };
}
