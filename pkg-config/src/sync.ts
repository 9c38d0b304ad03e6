import { fetchModule, wasmFile } from './locate.js';
import { syncInitFor } from './sync-init.js';

export * from './sync-exports.js';

/** Loads the single-threaded engine, which then answers at once on the thread that asks. */
export const init = syncInitFor(async (wasmUrl) =>
  wasmUrl ? fetchModule(wasmFile('single', String(wasmUrl))) : undefined,
);
