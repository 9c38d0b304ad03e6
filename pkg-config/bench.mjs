// Runs the benches: `native` (criterion), `wasm` (Node, beside native) and `peers` (beside other implementations), or
// those named.
import { join } from 'node:path';
import { assemble } from './tools/assemble.mjs';
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
};

await program(async () => {
  requireCargo();
  const named = process.argv.slice(2);
  const unknown = named.find((name) => !(name in BENCHES));
  if (unknown) throw new StepFailed(`unknown bench '${unknown}': ${Object.keys(BENCHES).join(', ')} are known`);
  for (const name of named.length ? named : Object.keys(BENCHES)) {
    say(`bench: ${name}`);
    await BENCHES[name]();
  }
});
