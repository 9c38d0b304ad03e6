import type { InitOptions, OrientOptions } from './api.js';
import { provide, useMain } from './more.js';
import { Engine } from './engine.js';
import { WindingError, describeError } from './error.js';
import type { Caller } from './held.js';
import type { Request } from './protocol.js';
import { facade } from './shapes.js';
import { hasSimd } from './simd.js';
import type { FastWinding } from './sync-api.js';

/** Runs an engine on the thread that asks. */
class Direct implements Caller {
  readonly info;
  private counter = 0;
  private ended: WindingError | undefined;

  constructor(private engine: Engine) {
    const reason = 'single-threaded: ./sync runs on the thread that calls it';
    this.info = { threads: 0, simd: true, reason, version: engine.version, memory: 0 };
  }

  newHandle(): number {
    return ++this.counter;
  }

  then(answer: unknown, f: (value: unknown) => unknown): unknown {
    return f(answer);
  }

  *each(list: unknown, size: number, ask: (part: Float64Array) => unknown): Generator<unknown> {
    const numbers = list as Float64Array;
    for (let from = 0; from < numbers.length; from += size) yield* ask(numbers.slice(from, from + size)) as unknown[];
  }

  fail(error: WindingError): never {
    throw error;
  }

  call(request: Request, options: OrientOptions | undefined): unknown {
    if (this.ended) {
      if (request.method === 'free') return undefined;
      throw this.ended;
    }
    let thrown: { error: unknown } | undefined;
    const { onProgress, onNormals } = options ?? {};
    const noting = <A extends unknown[]>(f: (...args: A) => void, ...args: A) => {
      try {
        if (!thrown) f(...args);
      } catch (error) {
        thrown = { error };
      }
    };
    // What the caller's functions throw ends the call.
    const progress = (onProgress ?? onNormals) && ((fraction: number, stage: string) => {
      if (onProgress) noting(onProgress, fraction, stage);
      if (thrown) throw thrown.error;
    });
    const watcher = onNormals && ((normals?: Float32Array) => {
      if (normals) noting(onNormals, normals);
      return true;
    });
    try {
      const value = this.engine.run(request, progress, watcher);
      if (thrown) throw thrown.error;
      return value;
    } catch (error) {
      if (thrown) throw thrown.error;
      const { error: data, fatal } = describeError(error);
      if (fatal) this.ended = new WindingError('Crashed', `${data.message}; call init again`);
      throw WindingError.from(data);
    }
  }

  dispose(): void {
    this.ended ??= new WindingError('Freed', 'the engine was disposed');
  }

  get isEnded(): boolean {
    return this.ended !== undefined;
  }
}

/** Options of `init` of `./sync`. */
export type SyncInitOptions = Pick<InitOptions, 'wasmUrl'>;

/** How a platform loads the WebAssembly of the single-threaded build. */
export interface SyncPlatform {
  /** `undefined` leaves it to wasm-bindgen's code, which finds it beside itself. */
  load(wasmUrl: string | undefined): Promise<WebAssembly.Module | undefined>;
  /** The part that some calls need. */
  more(wasmUrl: string | undefined): Promise<ArrayBuffer>;
}

/** `init` for a platform. */
export function syncInitFor(platform: SyncPlatform): (options?: SyncInitOptions) => Promise<FastWinding> {
  let engine: Promise<FastWinding> | undefined;
  let direct: Direct | undefined;
  /** The module holds one instance: after a crash or `dispose` it is made anew. */
  let isLoaded = false;

  async function start({ wasmUrl }: SyncInitOptions): Promise<FastWinding> {
    if (!hasSimd()) throw new WindingError('Unsupported', 'this machine has no WebAssembly SIMD, which the engine needs');
    const glue = await import('./single/fast_winding.js');
    const url = wasmUrl === undefined ? undefined : String(wasmUrl);
    // Calls answer at once: what some of them need is there before the first.
    const more = platform.more(url);
    more.catch(() => {});
    if (isLoaded) glue.__wbg_reset_state();
    useMain(await glue.default(isLoaded ? undefined : { module_or_path: (await platform.load(url))! }));
    await provide(() => more);
    isLoaded = true;
    direct = new Direct(new Engine(glue));
    return facade(direct) as FastWinding;
  }

  return (options = {}) => {
    if (direct?.isEnded) engine = direct = undefined;
    if (!engine) {
      engine = start(options);
      engine.catch(() => (engine = undefined));
    }
    return engine;
  };
}
