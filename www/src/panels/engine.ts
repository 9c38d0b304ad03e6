import type { Info } from 'fast-winding';
import { saveField } from '../actions/save.ts';
import { byId, setFacts } from '../dom.ts';
import { plural } from '../format.ts';
import type { Page } from '../page.ts';
import { sentence } from '../problem.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';
import { enableWhenUsable } from './usable.ts';

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

/** Saves the field that the engine has built, for the next time. */
export function fieldButton(page: Page): void {
  const button = byId<HTMLButtonElement>('field-save');
  enableWhenUsable(page, button);
  button.addEventListener('click', () => void saveField(page));
}

function threadsOf({ threads, simd }: Info): string {
  return `${plural(Math.max(1, threads), 'thread')}${simd ? ', SIMD' : ''}`;
}
