// Assembles pkg/, the npm package as it is published, and says how large it is.
import { assemble } from './tools/assemble.mjs';
import { pkg } from './tools/paths.mjs';
import { program, run } from './tools/run.mjs';

await program(async () => {
  await assemble();
  await run('npm', ['pack', '--dry-run'], { cwd: pkg });
});
