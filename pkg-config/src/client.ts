// The page's side: one call at a time goes to the worker, the others wait here, where they can still be withdrawn.
import { lockOf } from './alive.js';
import type { CallOptions, Info, OrientOptions } from './api.js';
import { WindingError } from './error.js';
import type { Caller } from './held.js';
import type { FromWorker, Platform, Port, Ready, Request, StartMessage } from './protocol.js';
import { Sources } from './sources.js';

interface Task {
  id: number;
  request: Request;
  /** Repeats a call for a new worker: its input is kept. */
  isReplay: boolean;
  onProgress: CallOptions['onProgress'];
  onNormals?: OrientOptions['onNormals'];
  resolve(value: unknown): void;
  reject(error: WindingError): void;
}

function buffersOf(args: unknown[]): ArrayBuffer[] {
  return args.filter(ArrayBuffer.isView).map((view) => view.buffer as ArrayBuffer);
}

function aborted(signal: AbortSignal): WindingError {
  return new WindingError('Aborted', 'aborted by the caller', { reason: signal.reason });
}

/** One engine in one worker, with its thread pool. */
export class Client implements Caller {
  readonly info: Info;
  /** Settles when the engine runs; rejects when it cannot. */
  readonly started: Promise<void>;
  private ready: Ready | undefined;
  private port: Port;
  private running: Task | undefined;
  private waiting: Task[] = [];
  private ended: WindingError | undefined;
  private readonly sources = new Sources();
  private readonly crashes: BroadcastChannel;
  private settleStart!: { resolve(): void; reject(error: WindingError): void };
  private counter = 0;
  /** Ends the watch over the threads of the worker. */
  private watch = new AbortController();

  constructor(
    private readonly platform: Platform,
    private readonly startMessage: StartMessage,
    private readonly workerUrl: string | URL | undefined,
    private readonly onEnd: () => void,
  ) {
    const client = this;
    this.info = {
      get threads() { return client.ready?.threads ?? 0; },
      simd: true,
      get reason() { return client.ready?.reason ?? ''; },
      get version() { return client.ready?.version ?? ''; },
      get memory() { return client.sources.bytes; },
    };
    this.started = new Promise((resolve, reject) => (this.settleStart = { resolve, reject }));
    this.crashes = new BroadcastChannel(startMessage.channel);
    this.crashes.onmessage = ({ data }) => this.crash(`a thread of the engine crashed: ${data}`);
    (this.crashes as unknown as { unref?(): void }).unref?.();
    this.port = this.startWorker();
  }

  private startWorker(): Port {
    const port = this.platform.startWorker(this.workerUrl, {
      message: (message) => port === this.port && this.hear(message),
      failure: (message) => port === this.port && this.crash(message),
    });
    port.post(this.startMessage, []);
    return port;
  }

  newHandle(): number {
    return ++this.counter;
  }

  then(answer: unknown, f: (value: unknown) => unknown): unknown {
    return (answer as Promise<unknown>).then(f);
  }

  async *each(list: unknown, size: number, ask: (part: Float64Array) => unknown): AsyncGenerator<unknown> {
    const numbers = (await list) as Float64Array;
    for (let from = 0; from < numbers.length; from += size) {
      yield* (await ask(numbers.slice(from, from + size))) as unknown[];
    }
  }

  fail(error: WindingError): unknown {
    return Promise.reject(error);
  }

  call(request: Request, options: OrientOptions | undefined): Promise<unknown> {
    const { signal, onProgress, onNormals } = options ?? {};
    if (request.method === 'free') return this.free(request);
    return new Promise((resolve, reject) => {
      if (this.ended) return reject(this.ended);
      if (signal?.aborted) return reject(aborted(signal));
      const stop = () => this.abort(task, aborted(signal!));
      const settle = () => signal?.removeEventListener('abort', stop);
      const task: Task = {
        id: ++this.counter,
        request,
        isReplay: false,
        onProgress,
        onNormals,
        resolve: (value) => (settle(), resolve(value)),
        reject: (error) => (settle(), reject(error)),
      };
      signal?.addEventListener('abort', stop, { once: true });
      this.waiting.push(task);
      this.next();
    });
  }

  /** Frees a shape after the calls that wait; nobody waits for it. */
  private async free(request: Request): Promise<void> {
    if (this.ended) return;
    const ignore = () => {};
    const task = { id: ++this.counter, request, isReplay: false, onProgress: undefined, resolve: ignore, reject: ignore };
    this.waiting.push(task);
    this.next();
  }

  /** Sends the next call, when the worker is idle. */
  private next(): void {
    this.port.keepAlive(this.ready === undefined || this.running !== undefined || this.waiting.length > 0);
    if (!this.ready || this.running || this.waiting.length === 0) return;
    const task = this.waiting.shift()!;
    this.running = task;
    this.port.keepAlive(true);
    this.cancelFlag(0);
    const { id, request } = task;
    // Without threads an abort costs the worker its shapes: what they were made of stays here.
    const isKept = this.ready.threads === 0;
    this.port.post({ type: 'call', id, watches: task.onNormals !== undefined, ...request }, isKept ? [] : buffersOf(request.args));
  }

  /** Tells the running call to stop, or to go on. Answers whether it can be told. */
  private cancelFlag(value: 0 | 1): boolean {
    const cancel = this.ready?.cancel;
    if (!cancel) return false;
    Atomics.store(new Int32Array(cancel.buffer, cancel.address, 1), 0, value);
    return true;
  }

  private abort(task: Task, error: WindingError): void {
    if (task !== this.running) {
      this.waiting = this.waiting.filter((other) => other !== task);
      task.reject(error);
    } else if (!this.cancelFlag(1)) {
      task.reject(error);
      this.replaceWorker();
    } else {
      task.reject = ((reject) => (failure) => reject(failure.code === 'Aborted' ? error : failure))(task.reject);
    }
    this.next();
  }

  /** Ends a worker that cannot be told to stop, and makes its shapes again in a new one, before the calls that wait. */
  private replaceWorker(): void {
    this.watch.abort();
    this.port.terminate();
    const lost = this.ready!;
    this.ready = undefined;
    this.running = undefined;
    this.startMessage.threads = 0;
    this.startMessage.reason = lost.reason;
    const replays = this.sources.all().map((request): Task => {
      const reject = (error: WindingError) => this.crash(`a shape could not be made again after an abort: ${error.message}`);
      return { id: ++this.counter, request, isReplay: true, onProgress: undefined, resolve: () => {}, reject };
    });
    this.waiting.unshift(...replays);
    this.port = this.startWorker();
  }

  private hear(message: FromWorker): void {
    if (message.type === 'ready') {
      this.ready = message;
      this.watchThreads(message.threads);
      this.settleStart.resolve();
      return this.next();
    }
    if (message.type === 'error' && message.id === undefined) return this.end(WindingError.from(message.error));
    const task = this.running;
    if (!task || task.id !== message.id) return;
    if (message.type === 'progress') return task.onProgress?.(message.fraction, message.stage);
    if (message.type === 'normals') return task.onNormals?.(message.normals);
    this.running = undefined;
    if (message.type === 'error') {
      task.reject(WindingError.from(message.error));
      if (message.fatal) return this.crash(message.error.message);
    } else {
      if (!task.isReplay && this.ready?.threads === 0) this.sources.note(task.request);
      task.resolve(message.value);
    }
    this.next();
  }

  private watchThreads(count: number): void {
    this.watch = new AbortController();
    const { channel } = this.startMessage;
    for (const thread of ['engine' as const, ...Array(count).keys()]) {
      const tell = () => this.crash('a thread of the engine was ended');
      this.platform.whenReleased?.(lockOf(channel, thread), this.watch.signal, tell);
    }
  }

  private crash(message: string): void {
    this.end(new WindingError('Crashed', `${message}; call init again`));
  }

  /** Ends the engine: every pending call and all later ones reject with `error`. */
  private end(error: WindingError): void {
    if (this.ended) return;
    this.ended = error;
    this.watch.abort();
    this.port.terminate();
    this.crashes.close();
    this.onEnd();
    this.settleStart.reject(error);
    for (const task of [this.running, ...this.waiting]) task?.reject(error);
    this.running = undefined;
    this.waiting = [];
  }

  dispose(): void {
    this.end(new WindingError('Freed', 'the engine was disposed'));
  }
}
