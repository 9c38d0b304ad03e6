/** An indexed triangle mesh: three numbers a vertex, three indices a face. */
export interface IndexedMesh {
  positions: Float32Array;
  indices: Uint32Array;
}

const STL_HEADER_BYTES = 84;
const STL_FACET_BYTES = 50;

/** The vertices of a binary STL, nine numbers a facet, in file order. */
export function readBinaryStl(bytes: Buffer): Float32Array {
  const facets = bytes.readUInt32LE(80);
  const corners = new Float32Array(9 * facets);
  for (let facet = 0; facet < facets; facet++) {
    const start = STL_HEADER_BYTES + STL_FACET_BYTES * facet + 12;
    for (let k = 0; k < 9; k++) corners[9 * facet + k] = bytes.readFloatLE(start + 4 * k);
  }
  return corners;
}

/** A binary STL of loose triangles; its normals are left zero, as readers recompute them. */
export function writeBinaryStl(corners: Float32Array): Buffer {
  const facets = corners.length / 9;
  const bytes = Buffer.alloc(STL_HEADER_BYTES + STL_FACET_BYTES * facets);
  bytes.writeUInt32LE(facets, 80);
  for (let facet = 0; facet < facets; facet++) {
    const start = STL_HEADER_BYTES + STL_FACET_BYTES * facet + 12;
    for (let k = 0; k < 9; k++) bytes.writeFloatLE(corners[9 * facet + k], start + 4 * k);
  }
  return bytes;
}

/** The mesh of an ASCII PLY whose vertices are `x y z` and whose faces are triangles. */
export function readAsciiPly(text: string): IndexedMesh {
  const vertices = Number(/element vertex (\d+)/.exec(text)?.[1]);
  const faces = Number(/element face (\d+)/.exec(text)?.[1]);
  const lines = text.slice(text.indexOf('end_header\n') + 'end_header\n'.length).split('\n');
  const positions = new Float32Array(3 * vertices);
  const indices = new Uint32Array(3 * faces);
  for (let i = 0; i < vertices; i++) positions.set(lines[i].split(' ', 3).map(Number), 3 * i);
  for (let i = 0; i < faces; i++) indices.set(lines[vertices + i].split(' ', 4).slice(1).map(Number), 3 * i);
  return { positions, indices };
}

/** A binary little-endian PLY of a mesh. */
export function writeMeshPly({ positions, indices }: IndexedMesh): Buffer {
  const header = plyHeader(`${vertexElement(positions)}\nelement face ${indices.length / 3}\nproperty list uchar uint vertex_indices`);
  const faces = Buffer.alloc((indices.length / 3) * 13);
  for (let face = 0; face < indices.length / 3; face++) {
    faces.writeUInt8(3, 13 * face);
    for (let k = 0; k < 3; k++) faces.writeUInt32LE(indices[3 * face + k], 13 * face + 1 + 4 * k);
  }
  return Buffer.concat([header, floats(positions), faces]);
}

/** A binary little-endian PLY of points with normals. */
export function writePointsPly(positions: Float32Array, normals: Float32Array): Buffer {
  const header = plyHeader(`${vertexElement(positions)}\nproperty float nx\nproperty float ny\nproperty float nz`);
  const rows = new Float32Array(2 * positions.length);
  for (let i = 0; i < positions.length / 3; i++) {
    rows.set(positions.subarray(3 * i, 3 * i + 3), 6 * i);
    rows.set(normals.subarray(3 * i, 3 * i + 3), 6 * i + 3);
  }
  return Buffer.concat([header, floats(rows)]);
}

export function writeObj({ positions, indices }: IndexedMesh): Buffer {
  const lines: string[] = [];
  for (let i = 0; i < positions.length; i += 3) lines.push(`v ${positions.subarray(i, i + 3).join(' ')}`);
  for (let i = 0; i < indices.length; i += 3) lines.push(`f ${indices[i] + 1} ${indices[i + 1] + 1} ${indices[i + 2] + 1}`);
  return Buffer.from(lines.join('\n') + '\n');
}

/** Three columns, one point a line. */
export function writeXyz(positions: Float32Array): Buffer {
  const lines: string[] = [];
  for (let i = 0; i < positions.length; i += 3) lines.push(positions.subarray(i, i + 3).join(' '));
  return Buffer.from(lines.join('\n') + '\n');
}

function plyHeader(elements: string): Buffer {
  return Buffer.from(`ply\nformat binary_little_endian 1.0\n${elements}\nend_header\n`);
}

function vertexElement(positions: Float32Array): string {
  return `element vertex ${positions.length / 3}\nproperty float x\nproperty float y\nproperty float z`;
}

function floats(values: Float32Array): Buffer {
  const bytes = Buffer.alloc(4 * values.length);
  values.forEach((value, i) => bytes.writeFloatLE(value, 4 * i));
  return bytes;
}
