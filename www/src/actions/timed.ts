import type { Timed } from '../state.ts';

/** The result of a call and how long it took. */
export async function timed<T>(call: () => Promise<T>): Promise<Timed<T>> {
  const start = performance.now();
  const value = await call();
  return { value, milliseconds: performance.now() - start };
}
