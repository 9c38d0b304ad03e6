// Where things lie. Every path is absolute.
import { homedir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const root = dirname(dirname(dirname(fileURLToPath(import.meta.url))));
export const www = join(root, 'www');
export const source = join(root, 'pkg-config');
export const pkg = join(root, 'pkg');
/** Kept between clones: tools that take minutes to build. */
export const cache = join(process.env.XDG_CACHE_HOME || join(homedir(), '.cache'), 'fast-winding');
export const toolsBin = join(cache, 'tools', 'bin');

/** The target directory of one wasm build; FAST_WINDING_TARGET moves all of them. */
export function wasmTarget(variant) {
  return join(process.env.FAST_WINDING_TARGET || join(root, 'target'), `wasm-${variant}`);
}
