import { byId } from '../dom.ts';
import type { Page } from '../page.ts';
import { isBusy } from '../state.ts';
import type { State } from '../state.ts';

/** Scrolls the figures of what was just made into sight where the panels have their own column; on a narrow page the view is what to look at. */
export function reveal({ job }: State, id: string): void {
  if (job && matchMedia('(min-width: 56rem)').matches) byId(id).scrollIntoView({ block: 'nearest' });
}

/** Whether a job can start; a button is then enabled. It also gets the focus back that it loses while its own job runs. */
export function enableWhenUsable({ store }: Page, button: HTMLButtonElement, isPossible: (state: State) => boolean = () => true): void {
  let hadFocus = false;
  store.on(['model', 'job', 'recipe', 'misfit', 'second', 'surface', 'repair', 'offset', 'combined', 'texture', 'seams'], (state) => {
    const { model } = state;
    hadFocus ||= document.activeElement === button;
    button.disabled = !model?.oriented || isBusy(state) || !isPossible(state);
    if (!button.disabled) {
      if (hadFocus && document.activeElement === document.body) button.focus();
      hadFocus = false;
    }
    button.title = model && !model.oriented ? 'Needs normals: estimate them first' : '';
  });
}
