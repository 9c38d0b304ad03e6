import type { Finding } from '../defects.ts';
import { byId } from '../dom.ts';
import { count } from '../format.ts';
import { shownOf } from '../shown.ts';
import type { ShownDefect, State } from '../state.ts';
import type { Store } from '../store.ts';

/** Fills a list with what was found: pressing an entry colours it and looks at it, with what else is to be `seen`. */
export function showFindings(store: Store<State>, list: HTMLElement, findings: readonly Finding<ShownDefect['kind']>[], seen: (state: State) => State['visible']): void {
  const stepper = byId('stepper');
  if (list.contains(stepper)) {
    stepper.hidden = true;
    list.after(stepper);
  }
  list.replaceChildren(...findings.map((finding) => entry(store, finding, seen)));
}

function entry(store: Store<State>, { kind, label, note, weight, figure }: Finding<ShownDefect['kind']>, seen: (state: State) => State['visible']): HTMLElement {
  const row = document.createElement('li');
  const button = document.createElement('button');
  const [name, figures] = ['label', 'figure'].map((part) => {
    const span = document.createElement('span');
    span.className = part;
    return span;
  });
  button.type = 'button';
  button.className = 'defect';
  button.dataset.defect = kind;
  button.dataset.weight = weight;
  button.title = note;
  button.setAttribute('aria-pressed', 'false');
  name.textContent = label;
  figures.textContent = figure;
  button.append(name, ' ', figures);
  button.addEventListener('click', () => {
    const isShown = store.state.defect?.kind === kind;
    store.set(isShown ? { defect: undefined } : { defect: { kind }, visible: seen(store.state), halves: false });
  });
  row.append(button);
  return row;
}

/** Below the entry that is pressed: what it means, and its places, which can be stepped through. To be called when the lists are there. */
export function defectStepper(store: Store<State>): void {
  byId('defect-previous').addEventListener('click', () => step(store, -1));
  byId('defect-next').addEventListener('click', () => step(store, 1));
  byId('defect-hide').addEventListener('click', () => {
    const kind = store.state.defect?.kind;
    store.set({ defect: undefined });
    document.querySelector<HTMLElement>(`[data-defect=${kind}]`)?.focus();
  });
  store.on(['defect', 'report', 'texture'], showChosen);
}

/** The next place, and after the last one the first. */
function step(store: Store<State>, by: number): void {
  const { defect } = store.state;
  const places = shownOf(store.state)?.places.length ?? 0;
  if (!defect || places === 0) return;
  const from = defect.place ?? (by > 0 ? -1 : 0);
  store.set({ defect: { ...defect, place: (from + by + places) % places } });
}

function showChosen(state: State): void {
  const { defect } = state;
  const shown = shownOf(state);
  const stepper = byId('stepper');
  stepper.hidden = !shown;
  for (const button of document.querySelectorAll<HTMLButtonElement>('.defect')) {
    const isShown = button.dataset.defect === defect?.kind;
    button.setAttribute('aria-pressed', String(isShown));
    if (isShown) button.after(stepper);
    if (isShown) byId('defect-note').textContent = button.title;
  }
  if (!defect || !shown) return;
  const places = shown.places.length;
  byId('defect-place').textContent = defect.place === undefined ? inWords(places) : `${count(defect.place + 1)} of ${count(places)}`;
  for (const id of ['defect-previous', 'defect-next']) byId<HTMLButtonElement>(id).disabled = places === 0;
}

function inWords(places: number): string {
  return places === 1 ? 'in one place' : `in ${count(places)} places`;
}
