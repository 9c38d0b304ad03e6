// What stops a run before its end: the user, the system, or a reader that has gone away.
import { setMaxListeners } from 'node:events';
import { EXIT } from './usage.js';

/** A signal for all calls, and the exit code once it has been given. */
export class Stop {
  private readonly controller = new AbortController();
  private code: number | undefined;

  constructor() {
    setMaxListeners(0, this.controller.signal);
    process.on('SIGINT', () => this.now(EXIT.interrupted));
    process.on('SIGTERM', () => this.now(EXIT.terminated));
    process.stdout.on('error', (error: NodeJS.ErrnoException) => {
      if (error.code !== 'EPIPE') throw error;
      this.now(EXIT.closedPipe);
    });
  }

  get signal(): AbortSignal {
    return this.controller.signal;
  }

  /** Stops the calls; the second time the program. */
  private now(code: number): void {
    if (this.code !== undefined) process.exit(code);
    this.code = code;
    this.controller.abort();
  }

  /** The exit code of a run that would have had this one. */
  codeOr(code: number): number {
    return this.code ?? code;
  }
}
