import { cloudsFile, fetchBytes, fetchModule, wasmFile } from './locate.js';
import { syncInitFor } from './sync-init.js';

export * from './sync-exports.js';

/** Loads the single-threaded engine, which then answers at once on the thread that asks. */
export const init = syncInitFor({
  load: async (wasmUrl) => (wasmUrl ? fetchModule(wasmFile('single', wasmUrl)) : undefined),
  clouds: async (wasmUrl) =>
    fetchBytes(wasmUrl ? cloudsFile('single', wasmUrl) : (await import('./clouds-wasm.js')).cloudsWasm.single),
});
