// The worker's side: starts the engine and answers calls, one at a time. The same in a browser and in Node.
import { hold, lockOf } from './alive.js';
import { describeError } from './error.js';
import { isMissing, provide, sharedPart, useMain } from './more.js';
import { Engine, type Glue } from './engine.js';
import type { Build } from './locate.js';
import { moreBytes, initialPages } from './threads/memory.js';
import { usePoolStarter } from './pool.js';
import { poolStarter } from './pool-start.js';
import type { FromWorker, Ready, StartMessage, ToWorker } from './protocol.js';

/** Sizes the shared memory may grow to, in pages of 64 KiB: 4, 2, 1 GiB, 512 MiB. Some devices refuse the larger. */
const MEMORY_MAXIMA = [65536, 32768, 16384, 8192];
/** Milliseconds between two reports of progress. */
const PROGRESS_INTERVAL = 30;
/** Milliseconds between two looks at normals that settle. */
const LOOK_INTERVAL = 100;

export interface Host {
  post(message: FromWorker, transfer: Transferable[]): void;
  /** The WebAssembly of a build, from `wasmUrl` or from beside this module; `undefined` leaves it to wasm-bindgen's code. */
  load(build: Build, wasmUrl: string | undefined): Promise<WebAssembly.Module | undefined>;
  /** The part that is loaded when first needed. */
  more(build: Build, wasmUrl: string | undefined): Promise<ArrayBuffer>;
}

function sharedMemory(): WebAssembly.Memory {
  let refusal: unknown;
  for (const maximum of MEMORY_MAXIMA) {
    try {
      return new WebAssembly.Memory({ initial: initialPages, maximum, shared: true });
    } catch (error) {
      refusal = error;
    }
  }
  throw refusal;
}

async function startThreads(host: Host, { threads, wasmUrl, channel, reason }: StartMessage): Promise<[Engine, Ready]> {
  const memory = sharedMemory();
  const module = await host.load('threads', wasmUrl);
  const glue = await import('./threads/fast_winding.js');
  const more = sharedPart(moreBytes);
  useMain(await glue.default({ module_or_path: module!, memory }), more);
  usePoolStarter(poolStarter(channel, more));
  await glue.initThreadPool(threads);
  const engine = new Engine(glue as unknown as Glue);
  const cancel = { buffer: memory.buffer as unknown as SharedArrayBuffer, address: engine.job.address() };
  return [engine, { type: 'ready', threads, reason, version: engine.version, cancel }];
}

async function startSingle(host: Host, { wasmUrl }: StartMessage, reason: string): Promise<[Engine, Ready]> {
  const module = await host.load('single', wasmUrl);
  const glue = await import('./single/fast_winding.js');
  useMain(await glue.default({ module_or_path: module! }));
  const engine = new Engine(glue);
  return [engine, { type: 'ready', threads: 0, reason, version: engine.version, cancel: undefined }];
}

async function start(host: Host, message: StartMessage): Promise<[Engine, Ready]> {
  let reason = message.reason;
  if (message.threads > 0) {
    try {
      return await startThreads(host, message);
    } catch (error) {
      reason = `single-threaded: threads could not start (${error instanceof Error ? error.message : String(error)})`;
    }
  }
  return startSingle(host, message, reason);
}

/** The buffers in a result: all of them are copies made for the caller, so they can be handed over. */
function buffersOf(value: unknown, found: Set<Transferable> = new Set()): Set<Transferable> {
  if (ArrayBuffer.isView(value)) found.add(value.buffer as ArrayBuffer);
  else if (typeof value === 'object' && value !== null) for (const part of Object.values(value)) buffersOf(part, found);
  return found;
}

function throttled(host: Host, id: number): (fraction: number, stage: string) => void {
  let last = -Infinity;
  return (fraction, stage) => {
    const now = performance.now();
    if (now - last < PROGRESS_INTERVAL && fraction < 1) return;
    last = now;
    host.post({ type: 'progress', id, fraction, stage }, []);
  };
}

function watcher(host: Host, id: number): (normals?: Float32Array) => boolean {
  let last = -Infinity;
  return (normals) => {
    if (!normals) return performance.now() - last >= LOOK_INTERVAL;
    last = performance.now();
    host.post({ type: 'normals', id, normals }, [normals.buffer as ArrayBuffer]);
    return true;
  };
}

/** Answers the messages of one client; returns the function to call with each. */
export function serve(host: Host): (message: ToWorker) => Promise<void> {
  let engine: Engine;
  let loadMore: () => Promise<ArrayBuffer>;
  const fail = (id: number | undefined, thrown: unknown) => host.post({ type: 'error', id, ...describeError(thrown) }, []);
  const begin = async (message: StartMessage) => {
    try {
      const [started, ready] = await start(host, message);
      engine = started;
      loadMore = () => host.more(ready.threads > 0 ? 'threads' : 'single', message.wasmUrl);
      await hold(lockOf(message.channel, 'engine'));
      host.post(ready, []);
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      const code = error instanceof WebAssembly.CompileError ? 'Unsupported' : 'Crashed';
      fail(undefined, { code, message: `the engine could not start: ${why}`, details: {} });
    }
  };
  return async (message) => {
    if (message.type === 'start') return begin(message);
    try {
      if (isMissing() && engine.needsMore(message)) await provide(loadMore);
      const value = engine.run(message, throttled(host, message.id), message.watches ? watcher(host, message.id) : undefined);
      host.post({ type: 'result', id: message.id, value }, [...buffersOf(value)]);
    } catch (error) {
      fail(message.id, error);
    }
  };
}
