import { byId } from '../dom.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

/** What went wrong, in words, beside the drop zone. */
export function problemPanel(store: Store<State>): void {
  store.on(['problem'], ({ problem, model }) => {
    byId('problem').hidden = !problem;
    byId('problem-title').textContent = problem?.title ?? '';
    byId('problem-detail').textContent = problem?.detail ?? '';
    byId('problem-kept').textContent = problem && model ? `${model.name} is still open.` : '';
    if (problem) byId('problem').scrollIntoView({ block: 'nearest' });
  });
  byId('problem-dismiss').addEventListener('click', () => {
    store.set({ problem: undefined });
    byId('choose').focus();
  });
}
