/** Wrong use of the command line: nothing has been done. */
export class UsageError extends Error {
  constructor(
    message: string,
    /** The command whose help tells more. */
    readonly command?: string,
  ) {
    super(message);
    this.name = 'UsageError';
  }
}

/** What the program's end says to whoever started it. */
export const EXIT = { done: 0, failed: 1, usage: 2, doesNotPrint: 3, closedPipe: 141, interrupted: 130, terminated: 143 } as const;
