import type { ErrorData } from './error.js';

/** One call of the engine, as it is posted to the worker. */
export interface Request {
  /** A method of the engine: see engine.ts. */
  method: string;
  /** The shape or the texture it is about, or the name of the shape it makes: chosen by the client. */
  handle: number;
  args: unknown[];
  /** The name of a shape or a texture that is made of that one. */
  makes?: number;
}

/** What a shape is, as far as it can be said without asking the engine again. */
export interface Description {
  kind: 'soup' | 'cloud';
  format: string;
  warnings: { code: string; count: number; message: string }[];
  bounds: { min: [number, number, number]; max: [number, number, number] };
  count: number;
  hasNormals: boolean;
  hasAreas: boolean;
}

export interface StartMessage {
  type: 'start';
  /** Threads to start; 0 asks for the single-threaded build, because of `reason`. */
  threads: number;
  reason: string;
  wasmUrl: string | undefined;
  /** Name of the channel on which a pool worker says that it trapped, and of the locks that its threads hold. */
  channel: string;
}

/** `watches`: whether the caller wants to see normals while they settle. */
export type ToWorker = StartMessage | ({ type: 'call'; id: number; watches: boolean } & Request);

export interface Ready {
  type: 'ready';
  threads: number;
  reason: string;
  version: string;
  /** With threads: where to store 1 to cancel the running call. */
  cancel: { buffer: SharedArrayBuffer; address: number } | undefined;
}

export type FromWorker =
  | Ready
  | { type: 'progress'; id: number; fraction: number; stage: string }
  | { type: 'normals'; id: number; normals: Float32Array }
  | { type: 'result'; id: number; value: unknown }
  /** Without an id: the engine did not start. */
  | { type: 'error'; id: number | undefined; error: ErrorData; fatal: boolean };

/** A worker as the client needs it, in a browser or in Node. */
export interface Port {
  post(message: ToWorker, transfer: Transferable[]): void;
  terminate(): void;
  /** In Node: whether this worker keeps the process alive. */
  keepAlive(alive: boolean): void;
}

export interface PortListener {
  message(message: FromWorker): void;
  /** The worker ended or never began. */
  failure(message: string): void;
}

/** What differs between a browser and Node. */
export interface Platform {
  startWorker(url: string | URL | undefined, listener: PortListener): Port;
  /** Processors of this machine. */
  processors(): number;
  /** A URL that means the same in a worker. */
  absoluteUrl(url: string | URL): string;
  /** Why memory cannot be shared between threads here, if it cannot. */
  obstacleToThreads(): string | undefined;
  /** Calls `tell` once no thread holds the lock of that name, where there are such; not after `signal`. */
  whenReleased?(name: string, signal: AbortSignal, tell: () => void): void;
}
