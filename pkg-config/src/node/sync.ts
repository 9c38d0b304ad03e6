import { readFile } from 'node:fs/promises';
import { pathToFileURL } from 'node:url';
import { fetchModule, wasmFile } from '../locate.js';
import { syncInitFor } from '../sync-init.js';

export * from '../sync-exports.js';

/** Loads the single-threaded engine, which then answers at once on the thread that asks. */
export const init = syncInitFor(async (wasmUrl) => {
  const beside = new URL('../single/fast_winding_bg.wasm', import.meta.url);
  const url = wasmUrl ? new URL(wasmFile('single', String(wasmUrl)), pathToFileURL('./')) : beside;
  return url.protocol === 'file:' ? WebAssembly.compile(await readFile(url)) : fetchModule(url);
});
