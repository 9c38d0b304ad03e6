// The engine's worker in Node: what a browser's worker has, made of node:worker_threads, then the same.
import { Worker as NodeWorker, parentPort } from 'node:worker_threads';
import type { ToWorker } from '../protocol.js';
import { moreOf, moduleOf } from './files.js';

/** As much of a browser's Worker as the thread pool uses. */
class PoolWorker {
  private readonly worker = new NodeWorker(new URL('./pool-worker.js', import.meta.url));

  addEventListener(type: 'message' | 'error', listener: (event: { data?: unknown; message?: string }) => void): void {
    if (type === 'message') this.worker.on('message', (data) => listener({ data }));
    else this.worker.on('error', (error) => listener({ message: error instanceof Error ? error.message : String(error) }));
  }
  postMessage(message: unknown): void {
    this.worker.postMessage(message);
  }
  terminate(): void {
    void this.worker.terminate();
  }
}
Object.assign(globalThis, { self: globalThis, Worker: PoolWorker });

const { serve } = await import('../serve.js');
const port = parentPort!;
const answer = serve({
  post: (message, transfer) => port.postMessage(message, transfer as never),
  load: moduleOf,
  more: moreOf,
});
port.on('message', (message: ToWorker) => answer(message));
