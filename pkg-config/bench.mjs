// Runs the benches: `native` (criterion), `wasm` (Node, beside native), `scale` (up to ten million triangles), `browser`
// (Chromium, beside three-mesh-bvh), `layers` (beside manifold-3d and trimesh), `booleans` (beside manifold-3d), `repairs` (taken by
// manifold-3d or not), `peers` (beside other implementations) and `figures` (those of the paper, as tables and as plots in
// docs/figures), or those named. What begins with -- and all after it goes to each of them; for the figures it is `--models` and files:
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
  async peers(options) {
    if (!which('python3')) throw new StepFailed('python3 is missing. On Debian: apt-get install -y python3 python3-venv');
    await npmInstall();
    await run('python3', [script('peers/compare.py'), ...options], { cwd: root });
  },
  async figures(options) {
    await npmInstall();
    const further = options.includes('--models') ? options.slice(options.indexOf('--models') + 1) : [];
    const folder = mkdtempSync(join(tmpdir(), 'fast-winding-'));
    try {
      const models = [...FIGURE_MODELS.map((name) => model(folder, name)), ...further.map((path) => resolve(path))];
      const cargo = ['run', '--release', '--example', 'figures', '--', join(root, 'docs/figures'), ...models];
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
  for (const name of named.length ? named : Object.keys(BENCHES)) {
    say(`bench: ${name}`);
    await BENCHES[name](options);
  }
});
