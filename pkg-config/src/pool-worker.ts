// One worker of the thread pool: it runs rayon's loop in the shared memory until it is ended.
import { hold, lockOf } from './alive.js';
import { useMain } from './more.js';
import type { PoolMessage } from './pool-start.js';

async function join({ module, memory, receiver, channel, thread, more }: PoolMessage): Promise<void> {
  const glue = await import('./threads/fast_winding.js');
  useMain(await glue.default({ module_or_path: module, memory }), more);
  await hold(lockOf(channel, thread));
  self.postMessage('fast-winding-pool-ready');
  try {
    glue.wbg_rayon_start_worker(receiver);
  } catch (error) {
    new BroadcastChannel(channel).postMessage(error instanceof Error ? error.message : String(error));
  }
}

self.addEventListener('message', ({ data }: MessageEvent) => {
  if (data?.type !== 'fast-winding-pool-start') return;
  join(data as PoolMessage).catch((error) => self.postMessage({ error: String(error) }));
});
self.postMessage('fast-winding-pool-listening');
