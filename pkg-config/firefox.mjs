// Tests of the package and the page in Firefox, where that is installed (or named in FIREFOX): `npm --prefix www run firefox`.
import { existsSync } from 'node:fs';
import { assemble } from './tools/assemble.mjs';
import { root, www } from './tools/paths.mjs';
import { StepFailed, program, run, which } from './tools/run.mjs';

const MAC = '/Applications/Firefox.app/Contents/MacOS/firefox';

await program(async () => {
  const firefox = process.env.FIREFOX ?? which('firefox') ?? which('firefox-esr') ?? (existsSync(MAC) ? MAC : undefined);
  if (!firefox) throw new StepFailed('Firefox is missing. On Debian: apt-get install -y firefox-esr; elsewhere set FIREFOX to its path');
  await assemble();
  await run('npm', ['run', 'build'], { cwd: www, quiet: true });
  await run('node', ['--test', 'tests/firefox/firefox.test.mjs'], { cwd: root, env: { FIREFOX: firefox } });
});
