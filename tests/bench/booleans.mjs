// Booleans of large closed meshes beside manifold-3d (npm), both in WebAssembly on one thread, the making of their inputs included:
// times, and volumes that have to agree. Run by `npm --prefix www run bench booleans [-- --quick]`.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { init } from '../../pkg/dist/node/sync.js';
import { manifold } from './manifold.mjs';
import { markdown, median, milliseconds, modelsFolder } from './measuring.mjs';
import { model } from './models.mjs';

const isQuick = process.argv.includes('--quick');
const RUNS = isQuick ? 3 : 7;
/** At most as many times manifold-3d's time; volumes agree to that share. */
const GOALS = { time: 2, volume: 1e-6 };
/** manifold-3d's names for ours. */
const OPERATIONS = { union: 'add', intersection: 'intersect', difference: 'subtract' };


/** A binary PLY of doubles, as models.mjs writes it; coordinates that both engines can have, in single precision. */
function read(path) {
  const bytes = readFileSync(path);
  const start = bytes.indexOf('end_header\n') + 'end_header\n'.length;
  const count = (what) => Number(new RegExp(`element ${what} (\\d+)`).exec(bytes.subarray(0, start).toString())[1]);
  const [vertices, faces] = [count('vertex'), count('face')];
  const positions = Float32Array.from({ length: 3 * vertices }, (_, i) => bytes.readDoubleLE(start + 8 * i));
  const first = start + 24 * vertices;
  const indices = Uint32Array.from({ length: 3 * faces }, (_, i) => bytes.readUInt32LE(first + 13 * Math.floor(i / 3) + 1 + 4 * (i % 3)));
  return { positions, indices };
}

/** The model turned a little, and shifted by a quarter of its size. */
function moved({ positions, indices }) {
  const size = [0, 1, 2].map((k) => {
    const all = positions.filter((_, i) => i % 3 === k);
    return all.reduce((a, b) => Math.max(a, b)) - all.reduce((a, b) => Math.min(a, b));
  });
  const [cz, sz, cx, sx] = [Math.cos(0.3), Math.sin(0.3), Math.cos(0.2), Math.sin(0.2)];
  const turned = new Float32Array(positions.length);
  for (let i = 0; i < positions.length; i += 3) {
    const [x, y, z] = positions.subarray(i, i + 3);
    const [v, w] = [cx * y - sx * z, sx * y + cx * z];
    turned.set([cz * x - sz * v + size[0] / 4, sz * x + cz * v + size[1] / 4, w + size[2] / 4], i);
  }
  return { positions: turned, indices };
}

function byManifold({ Manifold, Mesh }, [first, second], operation) {
  const start = performance.now();
  const solids = [first, second].map(({ positions, indices }) => new Manifold(new Mesh({ numProp: 3, vertProperties: positions, triVerts: indices })));
  const result = solids[0][OPERATIONS[operation]](solids[1]);
  const mesh = result.getMesh();
  const time = performance.now() - start;
  const found = { time, volume: result.volume(), count: mesh.numTri };
  [...solids, result].forEach((solid) => solid.delete());
  return found;
}

function byOurs(fw, [first, second], operation) {
  const start = performance.now();
  const shapes = [first, second].map((mesh) => fw.Soup.from(mesh));
  const { soup } = shapes[0].boolean(operation, shapes[1]);
  const { positions, indices, origin } = soup.geometry();
  const time = performance.now() - start;
  const at = (v) => [0, 1, 2].map((k) => positions[3 * v + k] + origin[k]);
  let volume = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [at(indices[i]), at(indices[i + 1]), at(indices[i + 2])];
    volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
  }
  [...shapes, soup].forEach((shape) => shape.free());
  return { time, volume, count: indices.length / 3 };
}

const fw = await init();
const peer = await manifold();
const rows = [];
const failures = [];
for (const name of ['bumpy70k', 'knot124k']) {
  const mesh = read(model(modelsFolder, name));
  const pair = [mesh, moved(mesh)];
  for (const operation of Object.keys(OPERATIONS)) {
    const runs = Array.from({ length: RUNS + 1 }, () => [byManifold(peer, pair, operation), byOurs(fw, pair, operation)]).slice(1);
    const [theirs, ours] = [0, 1].map((k) => ({ ...runs[0][k], time: median(runs.map((run) => run[k].time)) }));
    const [ratio, off] = [ours.time / theirs.time, Math.abs(ours.volume / theirs.volume - 1)];
    if (ratio > GOALS.time) failures.push(`${name} ${operation}: ${ratio.toFixed(2)} times as long`);
    if (off > GOALS.volume) failures.push(`${name} ${operation}: volumes differ by ${off.toExponential(1)}`);
    rows.push({
      model: name, operation, 'manifold-3d': milliseconds(theirs.time), ours: milliseconds(ours.time), ratio: ratio.toFixed(2),
      triangles: `${theirs.count} / ${ours.count}`, 'volumes differ by': off.toExponential(1),
    });
  }
}
console.log(markdown(rows));
fw.dispose();
if (failures.length > 0) {
  console.error(failures.join('\n'));
  process.exitCode = 1;
}
