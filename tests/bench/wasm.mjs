// Measures the package in Node on the Stanford bunny: one and two threads, beside the native build on as many.
// Run by `npm --prefix www run bench`; prints medians in milliseconds, and ratios.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { init } from '../../pkg/dist/node/index.js';

const root = new URL('../../', import.meta.url).pathname;
const model = join(root, 'www/node_modules/stl-models/objects/bunny.bin.stl');
const REPEATS = 7;

const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

async function timed(action) {
  await action(); // once unmeasured: the engine's code is compiled as it runs
  const times = [];
  for (let i = 0; i < REPEATS; i++) {
    const start = performance.now();
    await action();
    times.push(performance.now() - start);
  }
  return median(times);
}

/** The cell centres of a lattice, as points. */
function centres({ counts: [nx, ny, nz], origin, spacing }) {
  const points = new Float64Array(3 * nx * ny * nz);
  for (let i = 0; i < nx * ny * nz; i++) {
    const cell = [i % nx, Math.floor(i / nx) % ny, Math.floor(i / (nx * ny))];
    points.set(cell.map((c, axis) => origin[axis] + spacing[axis] * c), 3 * i);
  }
  return points;
}

async function measureWasm(threads, bytes) {
  const fw = await init({ threads });
  const shape = await fw.open(bytes);
  const points = centres(await shape.voxelize({ resolution: 50 }));
  const build = async () => {
    const fresh = await fw.open(bytes);
    const { milliseconds } = await fresh.prepare();
    fresh.free();
    return milliseconds;
  };
  await build();
  const builds = [];
  for (let i = 0; i < REPEATS; i++) builds.push(await build());
  const result = {
    'build the tree': median(builds),
    '50³ points, order 2, β 2': await timed(() => shape.windingNumbers(points, { order: 2, beta: 2 })),
    '50³ voxels': await timed(() => shape.voxelize({ resolution: 50 })),
    '100³ voxels': await timed(() => shape.voxelize({ resolution: 100 })),
    '60 layers': await timed(() => shape.slice({ layerHeight: (shape.bounds.max[2] - shape.bounds.min[2]) / 60 })),
    'surface, resolution 64': await timed(() => shape.surface({ resolution: 64 })),
  };
  fw.dispose();
  return result;
}

/** The native build through tests/bench/measure.rs: the rows that it has too. */
function measureNative(threads) {
  const folder = mkdtempSync(join(tmpdir(), 'fast-winding-bench-'));
  const env = { ...process.env, RAYON_NUM_THREADS: String(threads) };
  const measure = (resolution) => {
    const args = ['run', '--release', '--quiet', '--example', 'measure', '--', model, String(resolution), join(folder, 'values')];
    return JSON.parse(execFileSync('cargo', args, { cwd: root, env, encoding: 'utf8' }));
  };
  const runs = Array.from({ length: REPEATS }, () => [measure(50), measure(100)]);
  rmSync(folder, { recursive: true });
  const of = (key, which) => 1000 * median(runs.map((run) => run[which][key]));
  return {
    'build the tree': of('build', 0),
    '50³ points, order 2, β 2': of('scattered', 0),
    '50³ voxels': of('voxels', 0),
    '100³ voxels': of('voxels', 1),
  };
}

const bytes = readFileSync(model);
const [one, two] = [await measureWasm(1, bytes), await measureWasm(2, bytes)];
const [native, nativeTwo] = [measureNative(1), measureNative(2)];

const number = (value, digits, unit) => (value === undefined ? '–' : value.toFixed(digits) + unit);
const rows = Object.keys(one).map((name) => ({
  bunny: name,
  'wasm, 1 thread': number(one[name], 0, ' ms'),
  'wasm, 2 threads': number(two[name], 0, ' ms'),
  '2 threads gain': number(one[name] / two[name], 2, ' ×'),
  'native, 1 thread': number(native[name], 0, ' ms'),
  'wasm / native, 1 thread': number(native[name] && one[name] / native[name], 2, ' ×'),
  'wasm / native, 2 threads': number(native[name] && two[name] / nativeTwo[name], 2, ' ×'),
}));
const heads = Object.keys(rows[0]);
const line = (cells) => `| ${cells.join(' | ')} |`;
console.log([line(heads), line(heads.map((_, i) => (i ? '---:' : '---'))), ...rows.map((row) => line(Object.values(row)))].join('\n'));
