import { initFor } from '../init.js';
import { node } from './platform.js';

export * from '../exports.js';

/** Starts the engine in a worker, with threads. */
export const init = initFor(node);
