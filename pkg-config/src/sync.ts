import { fetchModule, wasmFile } from './locate.js';
import { syncInitFor } from './sync-init.js';

export * from './sync-exports.js';

/** Loads the single-threaded engine, which then answers at once on the thread that asks. */
export const init = syncInitFor((wasmUrl) =>
  fetchModule(wasmUrl ? wasmFile('single', String(wasmUrl)) : new URL('./single/fast_winding_bg.wasm', import.meta.url)),
);
