import { byId } from '../dom.ts';
import { MADE } from '../made.ts';
import { ITEMS } from '../state.ts';
import type { Item, State } from '../state.ts';
import type { Store } from '../store.ts';

/** One check box for each thing in the view; its swatch is the legend of the view's colours. */
export function showPanel(store: Store<State>): void {
  const boxes = new Map(ITEMS.map((item) => [item, toggle(store, item)]));
  byId('toggles').replaceChildren(...[...boxes.values()].map(({ row }) => row));
  const back = legendOfBackFaces();
  byId('toggles').append(back);
  store.on([...EVERY], (state) => {
    for (const [item, { row, input, text, swatch }] of boxes) {
      const { isThere, label, token } = describe(state, item);
      row.hidden = !isThere && NEWER.has(item);
      input.disabled = !isThere;
      input.checked = isThere && state.visible[item];
      text.textContent = label;
      swatch.style.setProperty('--swatch', `var(${token})`);
    }
    back.hidden = state.model?.shape.kind === 'cloud' && !state.voxels && !state.surface;
  });
}

/** Shown in the list only when they are there. */
const NEWER: ReadonlySet<Item> = new Set(['defects', 'repaired', 'difference', 'offset', 'second', 'combined', 'proxy', 'fieldLines', 'textured'] as const);

const EVERY = ['model', 'layer', 'defect', 'repair', 'voxels', 'comparison', 'surface', 'offset', 'second', 'combined', 'texture', 'print', 'visible'] as const satisfies readonly (keyof State)[];

interface Toggle {
  readonly row: HTMLElement;
  readonly input: HTMLInputElement;
  readonly text: HTMLElement;
  readonly swatch: HTMLElement;
}

function toggle(store: Store<State>, item: Item): Toggle {
  const row = document.createElement('li');
  const label = document.createElement('label');
  const input = document.createElement('input');
  const swatch = document.createElement('span');
  const text = document.createElement('span');
  label.className = 'check';
  swatch.className = ['boundary', 'normals', 'layer', 'fieldLines'].includes(item) ? 'swatch line' : 'swatch';
  input.type = 'checkbox';
  input.dataset.item = item;
  input.addEventListener('change', () => store.set({ visible: { ...store.state.visible, [item]: input.checked } }));
  label.append(input, swatch, text);
  row.append(label);
  return { row, input, text, swatch };
}

function describe({ model, layer, defect, repair, voxels, comparison, surface, offset, second, combined, texture, print }: State, item: Item): { isThere: boolean; label: string; token: string } {
  const isCloud = model?.shape.kind === 'cloud';
  switch (item) {
    case 'model':
      return { isThere: model !== undefined, label: isCloud ? 'Points' : 'Triangles', token: isCloud && !model.oriented ? '--view-points' : '--view-front' };
    case 'boundary':
      return { isThere: (model?.geometry.boundary.length ?? 0) > 0, label: 'Boundary edges', token: '--view-edge' };
    case 'normals':
      return { isThere: model?.geometry.normals !== undefined, label: 'Normals', token: '--view-normals' };
    case 'layer':
      return { isThere: layer !== undefined, label: 'Layer', token: '--view-layer' };
    case 'voxels':
      return { isThere: voxels !== undefined, ...MADE.voxels };
    case 'surface':
      return { isThere: surface !== undefined, ...MADE.surface };
    case 'defects':
      return { isThere: defect !== undefined, label: 'Defects', token: '--view-defect' };
    case 'repaired':
      return { isThere: repair !== undefined, ...MADE.repaired };
    case 'difference':
      return { isThere: comparison !== undefined, label: 'Wrong voxels', token: '--view-gained' };
    case 'offset':
      return { isThere: offset !== undefined, ...MADE.offset, ...(offset?.value.kind === 'hollow' ? { label: 'Hollow' } : {}) };
    case 'second':
      return { isThere: second !== undefined, label: 'Second model', token: '--view-second' };
    case 'combined':
      return { isThere: combined !== undefined, ...MADE.combined };
    case 'proxy':
      return { isThere: texture !== undefined, label: 'Charts', token: '--view-proxy' };
    case 'fieldLines':
      return { isThere: texture !== undefined, label: 'Field lines', token: '--view-field' };
    case 'textured':
      return { isThere: texture !== undefined, ...MADE.textured };
    case 'print':
      return { isThere: print !== undefined, ...MADE.print };
  }
}

function legendOfBackFaces(): HTMLElement {
  const row = document.createElement('li');
  row.className = 'check hint behind';
  row.innerHTML = '<span class="swatch" style="--swatch: var(--view-back)"></span><span>seen from behind</span>';
  return row;
}
