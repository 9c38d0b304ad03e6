import { syncInitFor } from '../sync-init.js';
import { moreOf, moduleOf } from './files.js';

export * from '../sync-exports.js';

/** Loads the single-threaded engine, which then answers at once on the thread that asks. */
export const init = syncInitFor({
  load: (wasmUrl) => moduleOf('single', wasmUrl),
  more: (wasmUrl) => moreOf('single', wasmUrl),
});
