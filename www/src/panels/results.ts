import { compareWith, removeResult, saveResult, showResult } from '../actions/results.ts';
import { byId } from '../dom.ts';
import { count, duration, plural } from '../format.ts';
import { ALL_MADE, isSolid, MADE, nameOf } from '../made.ts';
import type { Result } from '../made.ts';
import type { Page } from '../page.ts';
import type { State } from '../state.ts';

const SAVE = '<svg viewBox="0 0 16 16" aria-hidden="true"><path d="M8 2v8M4.5 7 8 10.5 11.5 7M3 13.5h10"/></svg>';
const REMOVE = '<svg viewBox="0 0 16 16" aria-hidden="true"><path d="M4 4l8 8M12 4l-8 8"/></svg>';

/** Everything that was made of the model: one press shows it, and what it is held against side by side. */
export function resultsPanel(page: Page): void {
  const { store } = page;
  const list = byId('results');
  const menu = byId<HTMLSelectElement>('against');
  store.on(['results'], ({ results }) => {
    byId('results-block').hidden = results.length === 0;
    const focused = list.contains(document.activeElement) ? document.activeElement!.id : undefined;
    list.replaceChildren(choice(page, undefined, 'The model'), ...results.map((result) => choice(page, result, nameOf(result, results))));
    if (focused) (document.getElementById(focused) ?? list.querySelector('input'))?.focus();
    const solid = results.filter(({ item }) => isSolid(item));
    menu.replaceChildren(new Option('the model', ''), ...solid.map((result) => new Option(nameOf(result, results), String(result.id))));
    menu.value = String(store.state.against?.id ?? '');
  });
  menu.addEventListener('change', () => compareWith(page, store.state.results.find(({ id }) => String(id) === menu.value)));
  store.on(['against'], ({ against }) => {
    menu.value = String(against?.id ?? '');
  });
  store.on(['results', 'visible', 'job', ...ALL_MADE.map((item) => MADE[item].slot)], (state) => {
    const shown = shownOf(state);
    for (const input of list.querySelectorAll<HTMLInputElement>('input')) input.checked = input.value === shown;
    for (const button of list.querySelectorAll('button')) button.disabled = state.job !== undefined;
  });
}

/** The only solid thing that is shown: a result, or the model; nothing if there are several. */
function shownOf({ visible, results, ...state }: State): string | undefined {
  const shown = (['model', ...ALL_MADE] as const).filter((item) => visible[item] && (item === 'model' || state[MADE[item].slot]));
  if (shown.length !== 1) return undefined;
  const [item] = shown;
  if (item === 'model') return '';
  return String(results.find(({ made }) => made === state[MADE[item].slot])?.id);
}

function choice(page: Page, result: Result | undefined, name: string): HTMLElement {
  const row = document.createElement('li');
  const label = document.createElement('label');
  const input = document.createElement('input');
  const swatch = document.createElement('span');
  const [title, figure] = [0, 1].map(() => document.createElement('span'));
  label.className = 'check';
  input.type = 'radio';
  input.name = 'result';
  input.id = `result-${result?.id ?? 'model'}`;
  input.value = String(result?.id ?? '');
  input.addEventListener('change', () => showResult(page, result));
  swatch.className = 'swatch';
  swatch.style.setProperty('--swatch', `var(${result ? MADE[result.item].token : '--view-front'})`);
  figure.className = 'figure';
  figure.textContent = result ? figureOf(result) : '';
  title.className = 'name';
  title.textContent = name;
  label.append(input, swatch, title, figure);
  row.append(label);
  if (result) {
    row.append(iconButton(`Save ${name}`, SAVE, () => void saveResult(page, result)), iconButton(`Remove ${name}`, REMOVE, () => removeResult(page, result)));
  }
  return row;
}

function iconButton(name: string, icon: string, press: () => void): HTMLButtonElement {
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'quiet icon';
  button.title = name;
  button.setAttribute('aria-label', name);
  button.innerHTML = icon;
  button.addEventListener('click', press);
  return button;
}

/** How much it is. */
export function figureOf(result: Result): string {
  switch (result.item) {
    case 'repaired':
    case 'combined':
      return triangles(result.made.value.triangles);
    case 'textured':
      return plural(result.made.value.report.charts, 'chart');
    case 'offset':
      return triangles(result.made.value.mesh);
    case 'surface':
      return triangles(result.made.value);
    case 'voxels':
      return `${count(result.made.value.count)} inside`;
    case 'print':
      return `${duration(result.made.value.gcode.estimate.seconds)} to print`;
  }
}

function triangles({ indices }: { readonly indices: Uint32Array }): string {
  return plural(indices.length / 3, 'triangle');
}
