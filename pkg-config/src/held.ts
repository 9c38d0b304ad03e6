// What the engine holds for the caller, and how it is asked.
import type { CallOptions, Info, OrientOptions } from './api.js';
import { WindingError } from './error.js';
import type { Request } from './protocol.js';

/** How calls are made: `R<T>` is a promise of T, or T. */
export interface Caller {
  readonly info: Info;
  call(request: Request, options: OrientOptions | undefined): unknown;
  /** Applies `f` to an answer of `call`. */
  then(answer: unknown, f: (value: unknown) => unknown): unknown;
  /** The items of the answers to calls for parts of a list of numbers, which is an answer too, `size` numbers to a part. */
  each(list: unknown, size: number, ask: (part: Float64Array) => unknown): unknown;
  /** Fails the way calls fail. */
  fail(error: WindingError): unknown;
  newHandle(): number;
  dispose(): void;
}

/** Options without those that the client itself heeds. */
export function forEngine(options: object | undefined): unknown {
  const { signal, onProgress, onNormals, transfer, ...rest } = (options ?? {}) as Record<string, unknown>;
  return Object.fromEntries(Object.entries(rest).filter(([, value]) => value !== undefined));
}

export type View = Uint8Array | Uint32Array | Float32Array | Float64Array;

/** The caller's numbers for the engine: a copy, or the caller's own buffer, which then becomes unusable for him. */
export function handOver<T extends View | ArrayBuffer | undefined>(data: T, transfer: boolean | undefined): T {
  if (data instanceof ArrayBuffer) return (transfer ? structuredClone(data, { transfer: [data] }) : data.slice(0)) as T;
  if (!ArrayBuffer.isView(data)) return data;
  if (transfer && data.buffer instanceof ArrayBuffer) return structuredClone(data, { transfer: [data.buffer] });
  return new (data.constructor as new (view: View) => View)(data) as T;
}

const forgotten = new FinalizationRegistry<() => void>((free) => free());

/** Something with a number in the engine, which is freed by the caller, or once it is collected. */
export class Held {
  protected isFreed = false;

  constructor(
    protected readonly caller: Caller,
    protected readonly handle: number,
    /** What it is called when it was freed. */
    private readonly noun: string,
  ) {
    forgotten.register(this, () => void caller.call({ method: 'free', handle, args: [] }, undefined), this);
  }

  protected ask(method: string, args: unknown[], options?: object, makes?: number): unknown {
    if (this.isFreed) return this.caller.fail(new WindingError('Freed', `this ${this.noun} was freed`));
    const request: Request = { method, handle: this.handle, args };
    return this.caller.call(makes === undefined ? request : { ...request, makes }, options as CallOptions | undefined);
  }

  free(): void {
    if (this.isFreed) return;
    void this.ask('free', []);
    this.isFreed = true;
    forgotten.unregister(this);
  }

  [Symbol.dispose](): void {
    this.free();
  }
}
