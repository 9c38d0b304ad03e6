// What estimates normals and areas of clouds, and what makes surfaces and layers, is a part of the WebAssembly of its own, loaded when
// first needed. Each thread has a table of functions of its own, into which it puts that part.
import type { ErrorData } from './error.js';

/** Threads share the part as bytes behind a flag that says that they are there. */
const FLAG_BYTES = 4;

/** Exports of the WebAssembly, as far as they are known here. */
type Exports = WebAssembly.Exports & { readonly isPlaced: WebAssembly.Global };

let main: Exports | undefined;
let part: WebAssembly.Module | undefined;
let shared: SharedArrayBuffer | undefined;
let failure = 'nothing loaded it';

/** Says where this thread's functions belong, after its WebAssembly was instantiated, and where threads share the part. */
export function useMain(exports: object, memory?: SharedArrayBuffer): void {
  main = exports as Exports;
  part = undefined;
  shared = memory;
}

/** Room for a part of `bytes` that threads share. */
export function sharedPart(bytes: number): SharedArrayBuffer {
  return new SharedArrayBuffer(FLAG_BYTES + bytes);
}

/** Whether this thread still has to be given the part. */
export function isMissing(): boolean {
  return part === undefined && !(shared && Atomics.load(new Int32Array(shared, 0, 1), 0));
}

/** Gives this thread, and those it shares with, the part that `load` gets. Why that fails is told when the part is needed. */
export async function provide(load: () => Promise<ArrayBuffer>): Promise<void> {
  try {
    const bytes = await load();
    const module = await WebAssembly.compile(bytes);
    if (shared) {
      const room = shared.byteLength - FLAG_BYTES;
      if (bytes.byteLength !== room) throw new Error(`it has ${bytes.byteLength} bytes, not ${room}: it is of another version`);
      new Uint8Array(shared, FLAG_BYTES).set(new Uint8Array(bytes));
      Atomics.store(new Int32Array(shared, 0, 1), 0, 1);
    }
    part = module;
  } catch (error) {
    failure = error instanceof Error ? error.message : String(error);
  }
}

/** Called by the WebAssembly: puts the part's functions in place for this thread. */
export function placeMore(): void {
  if (!main || main.isPlaced.value) return;
  if (isMissing()) {
    const message = `the part of the WebAssembly for normals, surfaces and layers could not be loaded: ${failure}`;
    throw { code: 'LoadFailed', message, details: {} } satisfies ErrorData;
  }
  part ??= new WebAssembly.Module(new Uint8Array(shared!, FLAG_BYTES).slice());
  new WebAssembly.Instance(part, { main });
  main.isPlaced.value = 1;
}
