import { moreFile, fetchBytes, fetchModule, wasmFile } from './locate.js';
import { syncInitFor } from './sync-init.js';

export * from './sync-exports.js';

/** Loads the single-threaded engine, which then answers at once on the thread that asks. */
export const init = syncInitFor({
  load: async (wasmUrl) => (wasmUrl ? fetchModule(wasmFile('single', wasmUrl)) : undefined),
  more: async (wasmUrl) =>
    fetchBytes(wasmUrl ? moreFile('single', wasmUrl) : (await import('./more-wasm.js')).moreWasm.single),
});
