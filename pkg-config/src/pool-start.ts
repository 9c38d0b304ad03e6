// Starts the workers of the thread pool.
import { isElsewhere, workerElsewhere } from './elsewhere.js';
import type { PoolStarter } from './pool.js';

export interface PoolMessage {
  type: 'fast-winding-pool-start';
  module: WebAssembly.Module;
  memory: WebAssembly.Memory;
  receiver: number;
  channel: string;
  /** Its place in the pool. */
  thread: number;
  /** The part of the WebAssembly that is loaded when first needed, once it is there. */
  more: SharedArrayBuffer;
}

/** Where this module lies when nothing has bundled it. */
const unbundled: string = import.meta.url;

function newWorker(): Worker {
  // Not `new URL(…, import.meta.url)`, which bundlers would take for one more file to bundle.
  const place = new URL('./pool-worker.js', unbundled);
  if (isElsewhere(place)) return workerElsewhere(place);
  return new Worker(new URL('./pool-worker.js', import.meta.url), { type: 'module' });
}

/** Resolves when `worker` has joined the pool. */
function joined(worker: Worker, message: PoolMessage): Promise<void> {
  return new Promise((resolve, reject) => {
    worker.addEventListener('message', ({ data }) => {
      if (data === 'fast-winding-pool-listening') worker.postMessage(message);
      else if (data === 'fast-winding-pool-ready') resolve();
      else if (data?.error) reject(new Error(data.error));
    });
    worker.addEventListener('error', (event) => {
      reject(new Error(event.message || 'a worker of the thread pool could not be loaded'));
    });
  });
}

/**
 * Starts a worker for each thread, then builds the pool. `channel` names the BroadcastChannel on which a worker says that
 * it trapped: the engine, blocked, could not hear it. In `more` a worker finds what was not loaded at first.
 */
export function poolStarter(channel: string, more: SharedArrayBuffer): PoolStarter {
  /** Kept so that no browser collects workers which only share memory. */
  const workers: Worker[] = [];
  return async (module, memory, builder) => {
    const receiver = builder.receiver();
    const message = (thread: number): PoolMessage => ({ type: 'fast-winding-pool-start', module, memory, receiver, channel, thread, more });
    try {
      for (let thread = 0; thread < builder.numThreads(); thread++) workers.push(newWorker());
      await Promise.all(workers.map((worker, thread) => joined(worker, message(thread))));
    } catch (error) {
      workers.forEach((worker) => worker.terminate());
      throw error;
    }
    builder.build();
  };
}
