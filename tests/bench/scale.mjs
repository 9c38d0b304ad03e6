// How time and memory grow with a closed soup: native up to ten million triangles, the single-threaded build of the package
// up to two. Run by `npm --prefix www run bench scale`; takes some minutes and 4 GB.
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { init } from '../../pkg/dist/node/sync.js';
import { markdown, measuringProgram, milliseconds, modelsFolder } from './measuring.mjs';
import { model } from './models.mjs';

const MODELS = ['bumpy70k', 'bumpy1m', 'bumpy2m', 'bumpy10m'];
const MOST_IN_WASM = 2_000_000;
const COUNTS = 100;

const program = measuringProgram();
const env = { ...process.env, RAYON_NUM_THREADS: '1' };

/** The job's figures on one thread, each job in a process of its own. */
function native(job, path, ...options) {
  const words = [job, path, '--repeats', '3', ...options];
  return JSON.parse(execFileSync(program, words, { env, encoding: 'utf8' }));
}

async function inWasm(path) {
  const fw = await init();
  const shape = fw.Soup.parse(readFileSync(path));
  const { milliseconds: build, bytes } = shape.prepare();
  const start = performance.now();
  shape.voxelize({ counts: [COUNTS, COUNTS, COUNTS] });
  const voxels = performance.now() - start;
  shape.free();
  return { build, voxels, bytes };
}

const rows = [];
for (const name of MODELS) {
  const path = model(modelsFolder, name);
  const voxels = native('voxels', path, '--counts', String(COUNTS));
  const { build, evaluation, elements, peak } = voxels;
  const row = {
    triangles: elements.toLocaleString('en'),
    'native: build': milliseconds(1000 * build),
    [`${COUNTS}³ voxels`]: milliseconds(1000 * evaluation),
    'peak of the build, a triangle': `${(peak / elements).toFixed(0)} bytes`,
    'wasm: with the index of points': '',
    [`wasm: ${COUNTS}³ voxels`]: '',
    'wasm: field, a triangle': '',
  };
  if (elements <= MOST_IN_WASM) {
    const wasm = await inWasm(path);
    row['wasm: with the index of points'] = milliseconds(wasm.build);
    row[`wasm: ${COUNTS}³ voxels`] = milliseconds(wasm.voxels);
    row['wasm: field, a triangle'] = `${(wasm.bytes / elements).toFixed(0)} bytes`;
  }
  rows.push(row);
  console.error(`${name}: done`);
}
console.log(markdown(rows));
