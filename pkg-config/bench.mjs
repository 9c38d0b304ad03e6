// Runs the benches: those of the README's tables, or those named.
//     native      criterion
//     wasm        WebAssembly in Node beside native
//     scale       up to ten million triangles
//     browser     Chromium, beside three-mesh-bvh
//     layers      beside manifold-3d and trimesh
//     prints      one thousand layers, and the share of slicing in preparing a print
//     booleans    beside manifold-3d
//     repairs     taken by manifold-3d or not
//     checks      what is wrong with a model, and turning its faces back
//     voxels      ways of making voxels, and saved fields
//     normals     normals of unoriented clouds
//     peers       winding numbers beside other implementations
//     surfaces    surfaces of clouds beside Poisson's
//     distances   beside Open3D and pysdf
//     charges     charges and field lines, beside the paper's tables
//     textures    beside standard projections
//     figures     those of the paper and of layers, as tables and as plots in docs/figures
// Peers are installed into throw-away environments under the user's cache. What begins with -- and all after it goes to each of
// them; for the figures it is `--only NAME` (scaling, layers, accuracy, quality), then `--models` and files:
//     npm --prefix www run bench peers -- --rounds 5
//     npm --prefix www run bench figures -- --models part.stl scan.ply
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { model } from '../tests/bench/models.mjs';
import { assemble } from './tools/assemble.mjs';
import { browser } from './tools/browser.mjs';
import { npmInstall } from './tools/npm.mjs';
import { root } from './tools/paths.mjs';
import { program, run, say, which, StepFailed } from './tools/run.mjs';
import { requireCargo } from './tools/rust.mjs';

const script = (name) => join(root, 'tests/bench', name);

const FIGURE_MODELS = ['bunny', 'teapot', 'gear', 'snowden', 'loose-bunny', 'dragon11k', 'dragon47k', 'dragon202k', 'dragon871k'];

/** Where models are written once; the peers look for them there too. */
const kept = (name) => model(join(process.env.CARGO_TARGET_DIR ?? join(root, 'target'), 'bench-models'), name);

/** Runs one of the crate's measuring programs. */
const example = (name, ...options) => run('cargo', ['run', '--release', '--example', name, '--', ...options], { cwd: root });

/** Runs a program beside implementations from PyPI. */
async function beside(name, options) {
  if (!which('python3')) throw new StepFailed('python3 is missing. On Debian: apt-get install -y python3 python3-venv');
  await npmInstall();
  await run('python3', [script(`peers/${name}.py`), ...options], { cwd: root });
}

const CLOUD_MODELS = ['bumpy70k', 'knot124k', 'bunny', 'dragon202k'];

const BENCHES = {
  native: (options) => run('cargo', ['bench', ...(options.length ? ['--', ...options] : [])], { cwd: root }),
  async wasm(options) {
    await assemble();
    await run('node', [script('wasm.mjs'), ...options], { cwd: root });
  },
  async layers(options) {
    await assemble();
    await run('node', [script('layers.mjs'), ...options], { cwd: root });
  },
  async booleans(options) {
    await assemble();
    await run('node', [script('booleans.mjs'), ...options], { cwd: root });
  },
  repairs: () => run('node', [script('repairs.mjs')], { cwd: root }),
  async scale() {
    await assemble();
    await run('node', [script('scale.mjs')], { cwd: root });
  },
  async browser(options) {
    await assemble();
    const { chromium } = await browser();
    await run('node', [script('browser.mjs'), ...options], { cwd: root, env: { CHROMIUM: chromium } });
  },
  async prints(options) {
    await npmInstall();
    await example('slices', kept('bumpy1m'), '--layers', '1000', ...options);
    for (const name of ['knot124k', 'bunny']) await example('print', kept(name), '--size', '80');
  },
  async checks() {
    await npmInstall();
    const models = ['knot124k', 'bunny', 'teapot', 'dragon202k'].map(kept);
    await example('checks', ...models);
    await example('orientation', ...models);
  },
  async voxels() {
    await npmInstall();
    ['bunny', 'teapot', 'knot124k', 'dragon202k'].forEach(kept);
    await example('voxels', 'tables');
    await example('voxels', 'saves', `loose:${kept('bumpy1m')}`, `points:${kept('bumpy2m')}`);
  },
  async normals(options) {
    await npmInstall();
    const models = CLOUD_MODELS.map(kept);
    if (options.length) return example('normals', ...models, ...options);
    await example('normals', ...models);
    await example('normals', ...models, kept('teapot'), '--points', '3000');
  },
  peers: (options) => beside('compare', options),
  surfaces: (options) => beside('surfaces', options),
  distances: (options) => beside('distance', options),
  charges: (options) => example('charges', ...options),
  textures: (options) => example('texture', ...options),
  async figures(options) {
    await npmInstall();
    const at = options.indexOf('--models');
    const [further, only] = at < 0 ? [[], options] : [options.slice(at + 1), options.slice(0, at)];
    const folder = mkdtempSync(join(tmpdir(), 'fast-winding-'));
    try {
      const models = [...FIGURE_MODELS.map((name) => model(folder, name)), ...further.map((path) => resolve(path))];
      const cargo = ['run', '--release', '--example', 'figures', '--', join(root, 'docs/figures'), ...models, ...only];
      await run('cargo', cargo, { cwd: root });
    } finally {
      rmSync(folder, { recursive: true });
    }
  },
};

await program(async () => {
  requireCargo();
  const words = process.argv.slice(2);
  const first = words.findIndex((word) => word.startsWith('--'));
  const [named, options] = first < 0 ? [words, []] : [words.slice(0, first), words.slice(first)];
  const unknown = named.find((name) => !(name in BENCHES));
  if (unknown) throw new StepFailed(`unknown bench '${unknown}': ${Object.keys(BENCHES).join(', ')} are known`);
  const failed = [];
  for (const name of named.length ? named : Object.keys(BENCHES)) {
    say(`bench: ${name}`);
    // One that fails, as where a peer cannot be installed, leaves the others their turn.
    await BENCHES[name](options).catch((error) => {
      console.error(`✗ ${name}: ${error.message}`);
      failed.push(name);
    });
  }
  if (failed.length) throw new StepFailed(`benches failed: ${failed.join(', ')}`);
});
