import { flatten, markSeam } from '../actions/texture.ts';
import { byId, setList } from '../dom.ts';
import { length } from '../format.ts';
import type { Page } from '../page.ts';
import { allOf } from '../state.ts';
import { lengthOf } from '../texture.ts';
import type { Mapping, Seam, Texturing } from '../texture.ts';
import { enableWhenUsable } from './usable.ts';

/** Seams that the person draws on the proxy, and the charts that are cut along them. */
export function seamsPanel(page: Page, wanted: () => Mapping): void {
  const { store } = page;
  const [draw, undo] = ['seam-draw', 'seam-undo'].map((id) => byId<HTMLButtonElement>(id));
  draw.addEventListener('click', () => {
    const isDrawing = !store.state.isDrawing;
    const { visible } = store.state;
    store.set({ isDrawing, seamStart: undefined, ...(isDrawing ? { visible: { ...allOf(false), layer: visible.layer, proxy: true }, halves: false } : {}) });
    if (isDrawing) byId('canvas').focus();
  });
  undo.addEventListener('click', () => {
    const { seams, seamStart } = store.state;
    const before = seams.at(-1)?.before;
    store.set(seamStart === undefined ? { seams: [...seams.slice(0, -1), ...(before ? [before] : [])] } : { seamStart: undefined });
  });
  byId('flatten').addEventListener('click', () => void flatten(page, wanted()));
  byId('canvas').addEventListener('mark', (event) => void markSeam(page, (event as CustomEvent<number>).detail));
  enableWhenUsable(page, draw, ({ texture }) => texture !== undefined);
  enableWhenUsable(page, byId<HTMLButtonElement>('flatten'), ({ texture }) => texture !== undefined);

  // Without the proxy in sight there is nothing to click.
  store.on(['visible', 'halves'], ({ visible, halves, isDrawing }) => {
    if (isDrawing && (!visible.proxy || halves)) store.set({ isDrawing: false, seamStart: undefined });
  });
  store.on(['isDrawing', 'seamStart'], ({ isDrawing, seamStart }) => {
    draw.setAttribute('aria-pressed', String(isDrawing));
    draw.textContent = isDrawing ? 'Stop drawing' : 'Draw a seam';
    byId('seam-cross').toggleAttribute('hidden', !isDrawing);
    byId('seam-hint').textContent = !isDrawing
      ? 'Charts are cut along them.'
      : seamStart === undefined
        ? 'Click where the seam starts; the end of one leads it on. With the keys: turn the view, Enter marks its middle.'
        : 'Click where it ends; the same place again takes it back.';
  });
  store.on(['seams', 'seamStart', 'job'], ({ seams, seamStart, job }) => {
    undo.disabled = job !== undefined || (seams.length === 0 && seamStart === undefined);
  });
  const tellStale = (): void => {
    const { texture, seams } = store.state;
    byId('seam-stale').hidden = !texture || isCut(texture.value, seams, wanted());
  };
  store.on(['seams', 'texture', 'job'], tellStale);
  for (const id of ['texture-cone', 'texture-only-seams']) byId(id).addEventListener('change', tellStale);
  store.on(['seams', 'texture'], ({ seams, texture }) => {
    const list = byId('seam-list');
    setList(list, texture ? seams.map((seam, k) => `Seam ${k + 1}, ${length(lengthOf(seam, texture.value.proxy))}`) : []);
    [...list.children].forEach((item, k) => item.append(remover(page, seams[k], k)));
  });
}

/** Whether the charts are as they would be cut now. */
function isCut({ seams: cut, mapping }: Texturing, seams: readonly Seam[], { cone, onlySeams }: Mapping): boolean {
  if (seams.length === 0 && cut.length === 0) return mapping.cone === cone;
  return seams === cut && mapping.cone === cone && mapping.onlySeams === onlySeams;
}

function remover({ store }: Page, seam: Seam, k: number): HTMLButtonElement {
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'link';
  button.textContent = 'Remove';
  button.setAttribute('aria-label', `Remove seam ${k + 1}`);
  button.addEventListener('click', () => {
    if (store.state.job) return;
    store.set({ seams: store.state.seams.filter((other) => other !== seam) });
    byId('seam-draw').focus();
  });
  return button;
}
