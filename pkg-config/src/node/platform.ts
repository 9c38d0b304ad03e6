import { availableParallelism } from 'node:os';
import { pathToFileURL } from 'node:url';
import { Worker } from 'node:worker_threads';
import type { Platform, Port, PortListener } from '../protocol.js';

/** What the engine needs of Node. */
export const node: Platform = {
  startWorker(url: string | URL | undefined, listener: PortListener): Port {
    const worker = new Worker(url ? new URL(url, pathToFileURL('./')) : new URL('./worker.js', import.meta.url));
    worker.on('message', (message) => listener.message(message));
    worker.on('error', (error) => listener.failure(error instanceof Error ? error.message : String(error)));
    worker.on('exit', (code) => listener.failure(`the worker ended with exit code ${code}`));
    return {
      post: (message, transfer) => worker.postMessage(message, transfer as never),
      terminate: () => void worker.terminate(),
      keepAlive: (alive) => (alive ? worker.ref() : worker.unref()),
    };
  },
  processors: availableParallelism,
  absoluteUrl: (url) => new URL(url, pathToFileURL('./')).href,
  obstacleToThreads: () => undefined,
};
