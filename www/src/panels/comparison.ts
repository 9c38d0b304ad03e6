import { compareMethods, showDifference } from '../actions/voxels.ts';
import { METHODS, methodsFor } from '../comparison.ts';
import type { ComparedMethod, ComparedVoxels, Comparison } from '../comparison.ts';
import { byId } from '../dom.ts';
import { count, milliseconds, significant } from '../format.ts';
import type { Page } from '../page.ts';
import { enableWhenUsable, reveal } from './usable.ts';

/** The method that voxels are made by, and all methods side by side. */
export function comparisonPanel(page: Page, wanted: () => { resolution: number; threshold: number }): () => ComparedMethod {
  const { store } = page;
  const menu = byId<HTMLSelectElement>('voxel-method');
  const describe = (): void => {
    byId('voxel-method-note').textContent = `${METHODS[menu.value as ComparedMethod].note}.`;
  };
  store.on(['model'], ({ model }) => {
    const methods = methodsFor(model?.shape.kind ?? 'soup');
    const chosen = methods.includes(menu.value as ComparedMethod) ? menu.value : methods[0];
    menu.replaceChildren(...methods.map((method) => new Option(METHODS[method].label, method)));
    menu.value = chosen;
    describe();
  });
  menu.addEventListener('change', describe);
  enableWhenUsable(page, byId<HTMLButtonElement>('voxel-compare'));
  byId('voxel-compare').addEventListener('click', () => {
    const { resolution, threshold } = wanted();
    void compareMethods(page, resolution, threshold);
  });
  store.on(['comparison'], (state) => {
    const { comparison } = state;
    byId('comparison').hidden = !comparison;
    if (comparison) byId('comparison-rows').replaceChildren(...comparison.rows.map((row) => line(page, row, comparison)));
    if (comparison) reveal(state, 'comparison');
  });
  return () => menu.value as ComparedMethod;
}

function line(page: Page, { method, milliseconds: time, difference }: ComparedVoxels, { rows, shown }: Comparison): HTMLElement {
  const row = document.createElement('tr');
  const name = document.createElement('th');
  name.scope = 'row';
  if (method === 'exact') name.textContent = METHODS[method].label;
  else name.append(choice(page, rows, method, method === shown));
  const { lost, gained, intersectionOverUnion } = difference;
  const wrong = method === 'exact' ? '–' : `${count(lost.length + gained.length)} (${significant(100 * (1 - intersectionOverUnion), 2)} %)`;
  const cells = [milliseconds(time), wrong].map((text) => {
    const cell = document.createElement('td');
    cell.textContent = text;
    return cell;
  });
  cells[1].title = `${count(lost.length)} missing, ${count(gained.length)} too many`;
  row.append(name, ...cells);
  return row;
}

/** Whose wrong voxels are coloured. */
function choice(page: Page, rows: readonly ComparedVoxels[], method: ComparedMethod, isShown: boolean): HTMLElement {
  const label = document.createElement('label');
  const input = document.createElement('input');
  input.type = 'radio';
  input.name = 'compared';
  input.value = method;
  input.checked = isShown;
  input.addEventListener('change', () => {
    showDifference(page, rows, method);
    byId('comparison-rows').querySelector<HTMLElement>(`[value=${method}]`)?.focus();
  });
  label.className = 'check';
  label.append(input, METHODS[method].label);
  return label;
}
