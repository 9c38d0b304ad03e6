// One worker of the thread pool in Node: what a browser's worker has, made of node:worker_threads, then the same.
import { parentPort } from 'node:worker_threads';

const port = parentPort!;
Object.assign(globalThis, {
  self: globalThis,
  postMessage: (message: unknown) => port.postMessage(message),
  addEventListener: (_type: string, listener: (event: { data: unknown }) => void) =>
    port.on('message', (data) => listener({ data })),
});
await import('../pool-worker.js');
