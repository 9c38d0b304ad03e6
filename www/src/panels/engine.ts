import type { Info } from 'fast-winding';
import { byId, setFacts } from '../dom.ts';
import { plural } from '../format.ts';
import { sentence } from '../problem.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

/** How the engine runs: threads, or why there is only one. */
export function enginePanel(store: Store<State>): void {
  store.on(['info'], ({ info }) => {
    if (!info) return;
    byId('engine').dataset.state = info.threads > 1 ? 'threads' : 'single';
    byId('engine').title = sentence(info.reason);
    byId('engine-text').textContent = threadsOf(info);
    byId('engine-reason').textContent = sentence(info.reason);
    setFacts(byId('engine-facts'), [
      ['Threads', String(Math.max(1, info.threads))],
      ['SIMD', info.simd ? 'yes' : 'no'],
      ['Version', info.version],
    ]);
  });
}

function threadsOf({ threads, simd }: Info): string {
  return `${plural(Math.max(1, threads), 'thread')}${simd ? ', SIMD' : ''}`;
}
