// Builds the WebAssembly, `threads` and `single`, unless their sources are as they were; or the variants named.
import { npmInstall } from './tools/npm.mjs';
import { program, say } from './tools/run.mjs';
import { buildVariant } from './tools/wasm.mjs';

await program(async () => {
  await npmInstall();
  const named = process.argv.slice(2);
  for (const variant of named.length ? named : ['threads', 'single']) {
    if (!(await buildVariant(variant))) say(`${variant}: up to date`);
  }
});
