// The API references of the crate and of the package, in target/, without warnings: rustdoc's and TypeDoc's.
import { join } from 'node:path';
import { npmExtra } from './npm.mjs';
import { root, source } from './paths.mjs';
import { run } from './run.mjs';

/** TypeDoc reads TypeScript by way of the compiler's own library, which TypeScript 7 no longer has: it gets the last that does. */
const TOOLS = ['typedoc@0.28.20', 'typescript@6.0'];

/** Makes both, or fails with what is wrong. The package has to be assembled: its types refer to those of the WebAssembly. */
export async function references() {
  await run('cargo', ['doc', '--no-deps'], { cwd: root, env: { RUSTDOCFLAGS: '-D warnings' }, quiet: true });
  await run('node', [join(await npmExtra(TOOLS), 'typedoc/bin/typedoc'), '--options', join(source, 'typedoc.json'), '--out', join(root, 'target', 'typedoc')], { cwd: source, quiet: true });
}
