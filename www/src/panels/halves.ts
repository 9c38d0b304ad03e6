import { byId } from '../dom.ts';
import { MADE, madeOf, nameOf } from '../made.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

/** The button that shows the model and what was made of it side by side. */
export function halvesButton(store: Store<State>): void {
  const button = byId<HTMLButtonElement>('halves');
  button.addEventListener('click', () => store.set({ halves: !store.state.halves }));
  store.on(['repair', 'combined', 'texture', 'offset', 'voxels', 'surface', 'visible', 'halves', 'results', 'against'], (state) => {
    const made = madeOf(state);
    button.disabled = !made;
    button.title = made ? '' : 'Needs a surface or another result: make one first';
    button.setAttribute('aria-pressed', String(state.halves));
    byId('half-names').hidden = !state.halves;
    const right = made && state.results.find((result) => result.made === state[MADE[made].slot]);
    byId('half-left').textContent = state.against ? nameOf(state.against, state.results) : 'Model';
    byId('half-made').textContent = right ? nameOf(right, state.results) : '';
    if (!made && state.halves) store.set({ halves: false });
  });
}
