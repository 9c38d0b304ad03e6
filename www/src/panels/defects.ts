import { defectsOf } from '../defects.ts';
import type { Defect } from '../defects.ts';
import { byId } from '../dom.ts';
import { count } from '../format.ts';
import { shownPlaces } from '../shown.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

/** What a check found: pressing an entry colours it and looks at it; its places can be stepped through. */
export function defectList(store: Store<State>): void {
  const list = byId('defects');
  store.on(['report'], ({ report }) => {
    const { found, absent } = report ? defectsOf(report.value) : { found: [], absent: [] };
    byId('stepper').hidden = true;
    list.after(byId('stepper'));
    list.replaceChildren(...found.map((defect) => entry(store, defect)));
    byId('check-absent').hidden = absent.length === 0;
    byId('check-absent').textContent = `Not found: ${absent.join(', ')}.`;
  });
  byId('defect-previous').addEventListener('click', () => step(store, -1));
  byId('defect-next').addEventListener('click', () => step(store, 1));
  byId('defect-hide').addEventListener('click', () => {
    const kind = store.state.defect?.kind;
    store.set({ defect: undefined });
    list.querySelector<HTMLElement>(`[data-defect=${kind}]`)?.focus();
  });
  store.on(['defect', 'report'], (state) => showChosen(state));
}

function entry(store: Store<State>, { kind, label, note, weight, figure }: Defect): HTMLElement {
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
    store.set(isShown ? { defect: undefined } : { defect: { kind }, visible: { ...store.state.visible, model: true, defects: true }, halves: false });
  });
  row.append(button);
  return row;
}

/** The next place, and after the last one the first. */
function step(store: Store<State>, by: number): void {
  const { defect } = store.state;
  const places = shownPlaces(store.state).length;
  if (!defect || places === 0) return;
  const from = defect.place ?? (by > 0 ? -1 : 0);
  store.set({ defect: { ...defect, place: (from + by + places) % places } });
}

function showChosen(state: State): void {
  const { defect, report } = state;
  const stepper = byId('stepper');
  stepper.hidden = !defect || !report;
  for (const button of byId('defects').querySelectorAll<HTMLButtonElement>('.defect')) {
    const isShown = button.dataset.defect === defect?.kind;
    button.setAttribute('aria-pressed', String(isShown));
    // The steps are below the entry that they are of.
    if (isShown) button.after(stepper);
    if (isShown) byId('defect-note').textContent = button.title;
  }
  if (!defect) return;
  const places = shownPlaces(state).length;
  byId('defect-place').textContent = defect.place === undefined ? inWords(places) : `${count(defect.place + 1)} of ${count(places)}`;
  for (const id of ['defect-previous', 'defect-next']) byId<HTMLButtonElement>(id).disabled = places === 0;
}

function inWords(places: number): string {
  return places === 1 ? 'in one place' : `in ${count(places)} places`;
}
