// Starts the workers of the thread pool: called by the threads build of the WebAssembly when its pool is made.

interface PoolBuilder {
  numThreads(): number;
  receiver(): number;
  build(): void;
}

export interface PoolMessage {
  type: 'fast-winding-pool-start';
  module: WebAssembly.Module;
  memory: WebAssembly.Memory;
  receiver: number;
  channel: string;
}

/** Where this module lies when nothing has bundled it. */
const unbundled: string = import.meta.url;
let crashChannel = '';
/** Kept so that no browser collects workers which only share memory. */
const workers: Worker[] = [];

/** Names the BroadcastChannel on which a pool worker says that it trapped: the engine, blocked, could not hear it. */
export function nameCrashChannel(name: string): void {
  crashChannel = name;
}

function newWorker(): Worker {
  try {
    return new Worker(new URL('./pool-worker.js', import.meta.url), { type: 'module' });
  } catch {
    // From another origin, such as a CDN, only a script of this one may start a worker: one that imports the other.
    // Not `new URL(…, import.meta.url)`, which bundlers would take for one more file to bundle.
    const url = new URL('./pool-worker.js', unbundled);
    const script = new Blob([`import ${JSON.stringify(url.href)};`], { type: 'text/javascript' });
    return new Worker(URL.createObjectURL(script), { type: 'module' });
  }
}

function startWorker(message: PoolMessage): Promise<Worker> {
  return new Promise((resolve, reject) => {
    const worker = newWorker();
    workers.push(worker);
    worker.addEventListener('message', ({ data }) => {
      if (data === 'fast-winding-pool-listening') worker.postMessage(message);
      else if (data === 'fast-winding-pool-ready') resolve(worker);
      else if (data?.error) reject(new Error(data.error));
    });
    worker.addEventListener('error', (event) => {
      reject(new Error(event.message || 'a worker of the thread pool could not be loaded'));
    });
  });
}

/** Part of the interface of wasm-bindgen-rayon: starts a worker for each thread of `builder`, then builds the pool. */
export async function startWorkers(module: WebAssembly.Module, memory: WebAssembly.Memory, builder: PoolBuilder): Promise<void> {
  const receiver = builder.receiver();
  const message: PoolMessage = { type: 'fast-winding-pool-start', module, memory, receiver, channel: crashChannel };
  try {
    await Promise.all(Array.from({ length: builder.numThreads() }, () => startWorker(message)));
  } catch (error) {
    workers.splice(0).forEach((worker) => worker.terminate());
    throw error;
  }
  builder.build();
}
