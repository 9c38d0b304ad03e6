// The API references of the crate and of the package, in target/, without warnings: rustdoc's and TypeDoc's.
import { existsSync, mkdirSync } from 'node:fs';
import { join } from 'node:path';
import { cache, root, source } from './paths.mjs';
import { run, say } from './run.mjs';

/** TypeDoc reads TypeScript by way of the compiler's own library, which TypeScript 7 no longer has: it gets the last that does. */
const TOOLS = ['typedoc@0.28.20', 'typescript@6.0'];

/** Path of the program, installed if need be. */
async function typedoc() {
  const folder = join(cache, 'tools', TOOLS.join('-'));
  const path = join(folder, 'node_modules', 'typedoc', 'bin', 'typedoc');
  if (!existsSync(path)) {
    say(`installing ${TOOLS.join(', ')}`);
    mkdirSync(folder, { recursive: true });
    await run('npm', ['install', '--prefix', folder, '--ignore-scripts', '--no-audit', '--no-fund', ...TOOLS], { cwd: folder, quiet: true });
  }
  return path;
}

/** Makes both, or fails with what is wrong. The package has to be assembled: its types refer to those of the WebAssembly. */
export async function references() {
  await run('cargo', ['doc', '--no-deps'], { cwd: root, env: { RUSTDOCFLAGS: '-D warnings' }, quiet: true });
  await run('node', [await typedoc(), '--options', join(source, 'typedoc.json'), '--out', join(root, 'target', 'typedoc')], { cwd: source, quiet: true });
}
