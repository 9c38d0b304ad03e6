// Measures the package in Node beside the native build: the single-threaded build against native on one thread, and the
// threads build on one and two threads. Run by `npm --prefix www run bench wasm [-- --quick]`; prints medians and ratios.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { init } from '../../pkg/dist/node/index.js';
import { init as initSync } from '../../pkg/dist/node/sync.js';
import { model, randomOf } from './models.mjs';
import { markdown, measuringProgram, milliseconds, modelsFolder, repeat } from './measuring.mjs';

const root = fileURLToPath(new URL('../../', import.meta.url));
const isQuick = process.argv.includes('--quick');
/** What is to be reached: wasm / native for crossings and trees, and for the dual tree; gain of the second thread. */
const [MOST_SLOWER, MOST_SLOWER_DUAL, LEAST_GAIN] = [2.5, 3.5, 1.7];
/** Shorter jobs need not gain from a second thread. */
const LONG = 300;

const counts = (count) => (isQuick ? Math.min(count, count > 100 ? 32 : 24) : count);
const JOBS = [
  { name: 'build, 71k triangles', model: 'bumpy70k', job: 'build', goal: MOST_SLOWER },
  { name: 'build, 1.07M triangles', model: 'bumpy1m', job: 'build', goal: MOST_SLOWER },
  { name: 'voxels, closed', model: 'bumpy70k', job: 'voxels', counts: counts(100), goal: MOST_SLOWER },
  { name: 'voxels, open', model: 'bunny', job: 'voxels', counts: counts(100), goal: MOST_SLOWER },
  { name: 'voxels, closed', model: 'bumpy70k', job: 'voxels', counts: counts(256), goal: MOST_SLOWER },
  { name: 'voxels, open', model: 'bunny', job: 'voxels', counts: counts(256), goal: MOST_SLOWER },
  { name: 'values ≤ 1e-3, loose soup', model: 'loose-bunny', job: 'values', tolerance: 1e-3, counts: counts(100), goal: MOST_SLOWER_DUAL },
  { name: 'values ≤ 1e-3, cloud', model: 'cloud-bunny35k', job: 'values', tolerance: 1e-3, counts: counts(100), goal: MOST_SLOWER_DUAL },
  { name: 'normals, 40k points', model: 'cloud-knot40k', job: 'orient', goal: MOST_SLOWER_DUAL },
  { name: 'contains, closed', model: 'bumpy70k', job: 'contains', scattered: isQuick ? 20_000 : 1_000_000, goal: MOST_SLOWER },
  { name: 'contains, open', model: 'bunny', job: 'contains', scattered: isQuick ? 20_000 : 1_000_000, goal: MOST_SLOWER },
];

/** A shape of a model file; promised or at once, as the engine `fw` answers. */
function open(fw, path) {
  return path.endsWith('.f64') ? fw.Cloud.from(recordsOf(path)) : fw.Soup.parse(readFileSync(path));
}

/** Points, normals and areas of a cloud's file. */
function recordsOf(path) {
  const bytes = readFileSync(path);
  const records = new Float64Array(bytes.buffer, bytes.byteOffset, bytes.length / 8);
  const count = records.length / 7;
  const column = (from, width) =>
    Float64Array.from({ length: count * width }, (_, i) => records[7 * Math.floor(i / width) + from + (i % width)]);
  return { points: column(0, 3), normals: column(3, 3), areas: column(6, 1) };
}

/** The points that a job asks: cell centres over the bounds, x fastest, or scattered in them from a seed. */
function pointsOf({ counts: count, scattered }, { min, max }) {
  const size = max.map((high, axis) => high - min[axis]);
  if (scattered) {
    const random = randomOf(7);
    return Float64Array.from({ length: 3 * scattered }, (_, i) => min[i % 3] + size[i % 3] * random());
  }
  const points = new Float64Array(3 * count ** 3);
  for (let i = 0; i < count ** 3; i++) {
    const cell = [i % count, Math.floor(i / count) % count, Math.floor(i / count ** 2)];
    for (let axis = 0; axis < 3; axis++) points[3 * i + axis] = min[axis] + (0.5 * size[axis]) / count + (size[axis] / count) * cell[axis];
  }
  return points;
}

/** Milliseconds of one job on an engine; the field is built before, unless the job is to build. */
async function measureWasm(fw, job, path, points) {
  if (job.job === 'build') {
    return repeat(async () => {
      const fresh = await open(fw, path);
      const prepared = await fresh.prepare();
      fresh.free();
      return prepared.milliseconds;
    });
  }
  if (job.job === 'orient') {
    const { points } = recordsOf(path);
    return repeat(async () => {
      const fresh = await fw.Cloud.from({ points });
      const start = performance.now();
      await fresh.orient();
      const time = performance.now() - start;
      fresh.free();
      return time;
    });
  }
  const shape = await open(fw, path);
  await shape.prepare();
  const ask = {
    voxels: () => shape.voxelize({ counts: [job.counts, job.counts, job.counts] }),
    values: () => shape.windingNumbers(points, { tolerance: job.tolerance }),
    contains: () => shape.contains(points),
  }[job.job];
  const time = await repeat(async () => {
    const start = performance.now();
    await ask();
    return performance.now() - start;
  });
  shape.free();
  return time;
}

/** The same by tests/bench/measure.rs, on one thread. */
function measureNative(program, job, path, pointsFile) {
  const args = [job.job, path];
  if (job.job === 'voxels') args.push('--counts', job.counts);
  // As `prepare` of the package: the index of points is built too.
  else if (job.job !== 'orient') args.push('--points', pointsFile);
  if (job.tolerance) args.push('--tolerance', job.tolerance);
  const env = { ...process.env, RAYON_NUM_THREADS: '1' };
  const times = JSON.parse(execFileSync(program, args.map(String), { cwd: root, env, encoding: 'utf8' }));
  return 1000 * (job.job === 'build' ? times.build : times.evaluation);
}

function row(job, { single, one, two, native }) {
  const [slower, gain] = [single / native, one / two];
  const asked = job.counts ? `${job.counts}³` : job.scattered ? `${job.scattered.toLocaleString('en')} scattered` : '';
  const missed = [slower > job.goal && 'ratio', one >= LONG && gain < LEAST_GAIN && 'gain'].filter(Boolean);
  return {
    job: job.name,
    asked,
    'native, 1 thread': milliseconds(native),
    'single build': milliseconds(single),
    'single / native': `${slower.toFixed(2)} ×`,
    goal: `≤ ${job.goal} ×`,
    'threads build, 1': milliseconds(one),
    'threads build, 2': milliseconds(two),
    'gain of the second': `${gain.toFixed(2)} ×${one < LONG ? ' (short)' : ''}`,
    met: missed.length ? `**no**: ${missed.join(', ')}` : 'yes',
  };
}

const engines = { single: await initSync(), one: await init({ threads: 1 }), two: await init({ threads: 2 }) };
const folder = mkdtempSync(join(tmpdir(), 'fast-winding-bench-'));
const program = measuringProgram();
const rows = [];
for (const job of JOBS) {
  const path = model(modelsFolder, job.model);
  const shape = open(engines.single, path);
  const points = job.job === 'values' || job.job === 'contains' ? pointsOf(job, shape.bounds) : undefined;
  shape.free();
  const pointsFile = join(folder, 'points.f64');
  if (points) writeFileSync(pointsFile, points);
  const times = { native: measureNative(program, job, path, pointsFile) };
  for (const [name, fw] of Object.entries(engines)) times[name] = await measureWasm(fw, job, path, points);
  rows.push(row(job, times));
  console.error(`${job.name}: done`);
}
rmSync(folder, { recursive: true });
engines.one.dispose();
engines.two.dispose();
console.log(`\nNode ${process.version}; the threads build runs in a worker: points and answers are copied between threads, which counts.\n`);
console.log(markdown(rows));
