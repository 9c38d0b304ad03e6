// What the threads build of the WebAssembly imports to start its pool. Apart from pool-start.ts, so that the workers of
// the pool, which load the same build, do not refer to themselves: bundlers handle such circles badly.

export interface PoolBuilder {
  numThreads(): number;
  receiver(): number;
  build(): void;
}

export type PoolStarter = (module: WebAssembly.Module, memory: WebAssembly.Memory, builder: PoolBuilder) => Promise<void>;

let starter: PoolStarter | undefined;

/** Says how the pool of this worker's engine is started. */
export function usePoolStarter(start: PoolStarter): void {
  starter = start;
}

/** Part of the interface of wasm-bindgen-rayon. */
export const startWorkers: PoolStarter = (module, memory, builder) => {
  if (!starter) throw new Error('nothing says how the thread pool is started');
  return starter(module, memory, builder);
};
