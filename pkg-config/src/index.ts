import { whenReleased } from './alive.js';
import { isElsewhere, workerElsewhere } from './elsewhere.js';
import { initFor } from './init.js';
import type { Platform, Port, PortListener } from './protocol.js';

export * from './exports.js';

/** Where this module lies when nothing has bundled it. */
const unbundled: string = import.meta.url;

function newWorker(url: string | URL | undefined): Worker {
  // Not `new URL(…, import.meta.url)`, which bundlers would take for one more file to bundle.
  const place = url ? new URL(url, location.href) : new URL('./worker.js', unbundled);
  if (isElsewhere(place)) return workerElsewhere(place);
  try {
    // Written out, so that bundlers find the worker.
    return url ? new Worker(url, { type: 'module' }) : new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
  } catch {
    // A page that is a file, or a bundle that is elsewhere: whether this one can be loaded is told by an event, as of all workers.
    return workerElsewhere(place);
  }
}

const browser: Platform = {
  startWorker(url: string | URL | undefined, listener: PortListener): Port {
    const worker = newWorker(url);
    worker.addEventListener('message', ({ data }) => listener.message(data));
    worker.addEventListener('error', ({ message }) => listener.failure(message || 'the worker could not be loaded'));
    return {
      post: (message, transfer) => worker.postMessage(message, transfer),
      terminate: () => worker.terminate(),
      keepAlive: () => {},
    };
  },
  processors: () => navigator.hardwareConcurrency || 1,
  absoluteUrl: (url) => new URL(url, location.href).href,
  obstacleToThreads: () =>
    globalThis.crossOriginIsolated === true
      ? undefined
      : 'the page is not cross-origin isolated (it needs the headers Cross-Origin-Opener-Policy: same-origin and ' +
        'Cross-Origin-Embedder-Policy: require-corp)',
  whenReleased,
};

/** Starts the engine in a worker, with threads where possible. */
export const init = initFor(browser);
