// Many inputs on a bounded number of engines.
import { availableParallelism } from 'node:os';
import type { FastWinding } from '../api.js';
import { initFor } from '../init.js';
import { node } from '../node/platform.js';

/** More files than this are not read at once, unless asked for: memory. */
const MOST_AT_ONCE = 8;

/** How many engines there are, and how many threads each has; `false` for the build without. */
export function share(files: number, threads: number | undefined, jobs: number | undefined): { lanes: number; threads: number | false } {
  const all = threads ?? availableParallelism();
  const lanes = Math.min(files, jobs ?? Math.min(Math.max(all, 1), MOST_AT_ONCE));
  return { lanes, threads: all === 0 ? false : Math.max(1, Math.floor(all / lanes)) };
}

/** Does `work` with each of `count` jobs, on `lanes` engines, until `signal` says stop. */
export async function runAll(
  count: number,
  { lanes, threads }: ReturnType<typeof share>,
  signal: AbortSignal,
  work: (index: number, engine: () => Promise<FastWinding>) => Promise<void>,
): Promise<void> {
  let next = 0;
  const lane = async () => {
    const init = initFor(node);
    let fw: FastWinding | undefined;
    // An engine that has crashed is started again for the next input.
    const engine = async () => (fw = await init({ threads, signal }));
    while (next < count && !signal.aborted) await work(next++, engine);
    fw?.dispose();
  };
  await Promise.all(Array.from({ length: lanes }, lane));
}
