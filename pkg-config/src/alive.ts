// How a page learns that a thread of its engine was ended from outside, as browsers do that run out of memory: each thread holds a
// lock for as long as it lives. No event tells of it, and the engine itself, blocked, could not.

/** The lock of a thread of the engine: `engine`, or the number of one of its pool. */
export const lockOf = (channel: string, thread: 'engine' | number): string => `${channel}/${thread}`;

/** Holds a lock until this thread ends. Resolves when it is held, and at once where there are no locks. */
export function hold(name: string): Promise<void> {
  return new Promise((resolve) => {
    const untilTheEnd = () => (resolve(), new Promise<never>(() => {}));
    const locks = (globalThis.navigator as Navigator | undefined)?.locks;
    if (locks) locks.request(name, untilTheEnd).catch(() => resolve());
    else resolve();
  });
}

/** Calls `tell` once nobody holds a lock, unless `signal` says that this no longer matters. */
export function whenReleased(name: string, signal: AbortSignal, tell: () => void): void {
  navigator.locks?.request(name, { signal }, () => signal.aborted || tell()).catch(() => {});
}
