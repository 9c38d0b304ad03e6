import { byId } from '../dom.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

/** The button that shows the model and what was made of it side by side. */
export function halvesButton(store: Store<State>): void {
  const button = byId<HTMLButtonElement>('halves');
  button.addEventListener('click', () => store.set({ halves: !store.state.halves }));
  store.on(['voxels', 'surface', 'halves'], ({ voxels, surface, halves }) => {
    const made = surface ? 'Surface' : voxels ? 'Voxels' : undefined;
    button.disabled = !made;
    button.title = made ? '' : 'Needs a surface or voxels: make them first';
    button.setAttribute('aria-pressed', String(halves));
    byId('half-names').hidden = !halves;
    byId('half-made').textContent = made ?? '';
    if (!made && halves) store.set({ halves: false });
  });
}
