// Runs the benches: `native` (criterion), `wasm` (Node, beside native), `peers` (beside other implementations) and
// `figures` (those of the paper, as tables and as plots in docs/figures), or those named. What follows `--` are further
// models for the figures.
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { assemble } from './tools/assemble.mjs';
import { writeModels } from './tools/bench-models.mjs';
import { npmInstall } from './tools/npm.mjs';
import { root } from './tools/paths.mjs';
import { program, run, say, which, StepFailed } from './tools/run.mjs';
import { requireCargo } from './tools/rust.mjs';

const BENCHES = {
  native: () => run('cargo', ['bench'], { cwd: root }),
  async wasm() {
    await assemble();
    await run('cargo', ['build', '--release', '--example', 'measure'], { cwd: root });
    await run('node', [join(root, 'tests/bench/wasm.mjs')], { cwd: root });
  },
  async peers() {
    if (!which('python3')) throw new StepFailed('python3 is missing. On Debian: apt-get install -y python3 python3-venv');
    await run('python3', [join(root, 'tests/bench/peers/compare.py')], { cwd: root });
  },
  async figures(furtherModels) {
    await npmInstall();
    const folder = mkdtempSync(join(tmpdir(), 'fast-winding-'));
    try {
      const models = [...writeModels(folder), ...furtherModels];
      const cargo = ['run', '--release', '--example', 'figures', '--', join(root, 'docs/figures'), ...models];
      await run('cargo', cargo, { cwd: root });
    } finally {
      rmSync(folder, { recursive: true });
    }
  },
};

await program(async () => {
  requireCargo();
  const given = process.argv.slice(2);
  const split = given.includes('--') ? given.indexOf('--') : given.length;
  const [named, furtherModels] = [given.slice(0, split), given.slice(split + 1).map((path) => resolve(path))];
  const unknown = named.find((name) => !(name in BENCHES));
  if (unknown) throw new StepFailed(`unknown bench '${unknown}': ${Object.keys(BENCHES).join(', ')} are known`);
  for (const name of named.length ? named : Object.keys(BENCHES)) {
    say(`bench: ${name}`);
    await BENCHES[name](furtherModels);
  }
});
