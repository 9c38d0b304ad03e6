import type { FastWinding, InitOptions } from './api.js';
import { Client } from './client.js';
import { WindingError } from './error.js';
import { facade } from './shapes.js';
import type { Platform } from './protocol.js';
import { hasSimd } from './simd.js';

/** More threads than this cost memory and gain nothing on the models seen. */
const MOST_THREADS = 32;

function threadsFor(platform: Platform, wanted: InitOptions['threads']): { threads: number; reason: string } {
  if (wanted === false || wanted === 0) return { threads: 0, reason: 'single-threaded: as asked' };
  const obstacle = platform.obstacleToThreads();
  if (obstacle) return { threads: 0, reason: `single-threaded: ${obstacle}` };
  const isNumber = typeof wanted === 'number';
  const count = isNumber ? wanted : platform.processors();
  if (!Number.isInteger(count) || count < 1) {
    throw new WindingError('InvalidArgument', `threads: ${wanted}: 'auto', false or a whole number from 0 is needed`);
  }
  const threads = Math.min(count, MOST_THREADS);
  return { threads, reason: `${threads} threads: ${isNumber ? 'as asked' : 'one for each processor'}` };
}

/** Gives up waiting when `signal` says so; the engine goes on starting for others. */
function until<T>(promise: Promise<T>, signal: AbortSignal | undefined): Promise<T> {
  if (!signal) return promise;
  return new Promise((resolve, reject) => {
    const stop = () => reject(new WindingError('Aborted', 'aborted by the caller', { reason: signal.reason }));
    if (signal.aborted) return stop();
    signal.addEventListener('abort', stop, { once: true });
    promise.then(resolve, reject).finally(() => signal.removeEventListener('abort', stop));
  });
}

/** `init` for a platform. */
export function initFor(platform: Platform): (options?: InitOptions) => Promise<FastWinding> {
  const engines = new Map<string, Promise<FastWinding>>();

  async function start(key: string, options: InitOptions): Promise<FastWinding> {
    if (!hasSimd()) throw new WindingError('Unsupported', 'this browser has no WebAssembly SIMD, which the engine needs');
    const { threads, reason } = threadsFor(platform, options.threads);
    const wasmUrl = options.wasmUrl === undefined ? undefined : platform.absoluteUrl(options.wasmUrl);
    const channel = `fast-winding-${crypto.randomUUID?.() ?? Math.random()}`;
    const message = { type: 'start' as const, threads, reason, wasmUrl, channel };
    const client = new Client(platform, message, options.workerUrl, () => engines.delete(key));
    await client.started;
    return facade(client) as FastWinding;
  }

  return (options = {}) => {
    const key = JSON.stringify([options.threads ?? 'auto', options.wasmUrl, options.workerUrl]);
    let engine = engines.get(key);
    if (!engine) {
      engine = start(key, options);
      engines.set(key, engine);
      engine.catch(() => engines.delete(key));
    }
    return until(engine, options.signal);
  };
}
