// Repaired meshes handed to manifold-3d (npm): whether its constructor takes them, and whether it finds the same volume.
// Run by `npm --prefix www run bench repairs`, or `node tests/bench/repairs.mjs [CASE]`, where CASE is the beginning of a name; builds and runs tests/bench/repair.rs.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { manifold } from './manifold.mjs';
import { markdown, modelsFolder } from './measuring.mjs';
import { model } from './models.mjs';

const root = fileURLToPath(new URL('../..', import.meta.url));
/** How far the volumes may be apart. */
const GOAL = 1e-6;

const read = (path, Type) => {
  const bytes = readFileSync(path);
  return new Type(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
};

/** By the divergence theorem, about the middle of the first vertex. */
function volumeOf(positions, indices) {
  let six = 0;
  const at = (v, k) => positions[3 * v + k] - positions[k];
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => [0, 1, 2].map((axis) => at(indices[t + k], axis)));
    six += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return six / 6;
}

/** What manifold-3d, which holds single precision, makes of a mesh. */
function takenBy({ Manifold, Mesh }, positions, indices) {
  // About its middle: single precision loses least there.
  const middle = [0, 1, 2].map((axis) => {
    let [low, high] = [Infinity, -Infinity];
    for (let i = axis; i < positions.length; i += 3) [low, high] = [Math.min(low, positions[i]), Math.max(high, positions[i])];
    return (low + high) / 2;
  });
  const vertProperties = Float32Array.from(positions, (x, i) => x - middle[i % 3]);
  try {
    const solid = new Manifold(new Mesh({ numProp: 3, vertProperties, triVerts: indices }));
    const status = solid.status();
    const volume = solid.volume();
    solid.delete();
    return { status, volume, own: volumeOf(vertProperties, indices) };
  } catch (error) {
    return { status: error.message };
  }
}

const share = (x) => `${(100 * x).toFixed(2)} %`;
const wanted = process.argv[2] ?? '';
const folder = join(tmpdir(), 'fast-winding-repairs');
// A CAD part, a truck and a rotor are no packages': their cases are left out unless the models lie there.
for (const name of ['bunny', 'loose-bunny', 'teapot', 'snowden', 'bumpy70k', 'knot124k']) model(modelsFolder, name);
const output = execFileSync('cargo', ['run', '--release', '--quiet', '--example', 'repair', '--', folder, wanted], { cwd: root, maxBuffer: 1 << 28 });
const results = output.toString().trim().split('\n').map((line) => JSON.parse(line));
const peer = await manifold();
const columns = ['case', 'method', 'triangles', 'result', 'kept', 'holes', 'split', 'flipped', 'agreement', 'closed', 'pairs that cross', 'manifold-3d', 'volumes apart', 'seconds'];
const nothing = Object.fromEntries(columns.map((column) => [column, '']));
const rows = results.map(({ case: name, method, triangles, seconds, result, report, crossings, error }) => {
  if (error) return { ...nothing, case: name, method, triangles, result: error };
  const stem = join(folder, `${name}.${method}`);
  const positions = read(`${stem}.f64`, Float64Array);
  const taken = takenBy(peer, positions, read(`${stem}.u32`, Uint32Array));
  const apart = Math.abs(taken.volume / report.volume - 1);
  return {
    case: name,
    method,
    triangles,
    result,
    kept: report.method === 'conserve' ? report.kept : '',
    holes: report.holes,
    split: report.intersecting,
    flipped: report.flipped,
    agreement: share(report.agreement),
    closed: report.closed ? 'yes' : 'no',
    'pairs that cross': crossings,
    'manifold-3d': taken.status,
    'volumes apart': taken.volume === undefined ? '' : `${apart.toExponential(1)} (${GOAL.toExponential(0)})`,
    seconds: seconds.toFixed(2),
  };
});
console.log(markdown(rows));
const failed = results.filter((r, k) => r.error || rows[k]['manifold-3d'] !== 'NoError' || !(parseFloat(rows[k]['volumes apart']) <= GOAL));
console.log(`${results.length - failed.length} of ${results.length} are taken, with the same volume.`);
