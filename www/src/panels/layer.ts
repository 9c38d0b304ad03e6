import type { Bounds } from 'fast-winding';
import { saveLayer } from '../actions/save.ts';
import { diagonal } from '../bounds.ts';
import { areaOf, perimeterOf, ringsOf } from '../contour.ts';
import { byId, paintSlider, setFacts } from '../dom.ts';
import { count, milliseconds, significant } from '../format.ts';
import type { Page } from '../page.ts';
import { heightOf, planeFor, withLayerHeight } from '../plane.ts';
import type { State } from '../state.ts';

/** More layers than this are a mistyped layer height, and too fine for a slider. */
const MOST_LAYERS = 100_000;

export function layerPanel(page: Page): void {
  const { store } = page;
  const slider = byId<HTMLInputElement>('layer-slider');
  const height = byId<HTMLInputElement>('layer-height');
  const heat = byId<HTMLInputElement>('heat');
  const distance = byId<HTMLInputElement>('distance');
  const cut = byId<HTMLInputElement>('cut');

  slider.addEventListener('input', () => store.set({ plane: { ...store.state.plane, index: slider.valueAsNumber } }));
  // One colour at a time.
  heat.addEventListener('change', () => store.set({ planeColours: heat.checked ? 'winding' : 'none' }));
  distance.addEventListener('change', () => store.set({ planeColours: distance.checked ? 'distance' : 'none' }));
  store.on(['planeColours'], ({ planeColours }) => {
    heat.checked = planeColours === 'winding';
    distance.checked = planeColours === 'distance';
  });
  cut.addEventListener('change', () => store.set({ cutAway: cut.checked }));
  byId('layer-download').addEventListener('click', () => {
    const layer = store.state.layer?.value;
    if (layer) void saveLayer(page, layer);
  });
  height.addEventListener('change', () => {
    const { model, plane } = store.state;
    const isUsable = model && height.valueAsNumber > 0 && planeFor(model.bounds, height.valueAsNumber).count <= MOST_LAYERS;
    if (isUsable) store.set({ plane: withLayerHeight(plane, model.bounds, height.valueAsNumber) });
    else height.value = String(plane.layerHeight);
  });

  store.on(['plane', 'model'], ({ plane, model }) => {
    const isUsable = model?.oriented ?? false;
    slider.disabled = height.disabled = heat.disabled = distance.disabled = cut.disabled = !isUsable;
    slider.max = String(Math.max(0, plane.count - 1));
    slider.valueAsNumber = plane.index;
    height.value = String(plane.layerHeight);
    paintSlider(slider);
    const z = model ? heightOf(plane, model.bounds) : 0;
    slider.setAttribute('aria-valuetext', `layer ${plane.index + 1} of ${plane.count}, z ${significant(z)} millimetres`);
    byId('layer-out').textContent = model ? `layer ${count(plane.index + 1)} of ${count(plane.count)}` : '';
    byId('layer-z').textContent = model ? `z = ${fixedHeight(z, model.bounds)} mm` : '';
  });
  store.on(['layer', 'heat', 'distances', 'model'], showFacts);
}

function showFacts({ layer, heat, distances, model }: State): void {
  byId<HTMLButtonElement>('layer-download').disabled = !layer;
  if (!layer) {
    const reason = model && !model.oriented ? ([['Layer', 'needs normals']] as const) : [];
    return setFacts(byId('layer-facts'), reason);
  }
  const { value, milliseconds: time } = layer;
  setFacts(byId('layer-facts'), [
    ['Contours', contours(value.polygons.length, ringsOf(value).length - value.polygons.length)],
    ['Area', `${significant(areaOf(value))} mm²`],
    ['Perimeter', `${significant(perimeterOf(value))} mm`],
    ['Layer computed', milliseconds(time)],
    ...(heat ? ([['Heat map computed', milliseconds(heat.milliseconds)]] as const) : []),
    ...(distances ? ([['Distances computed', milliseconds(distances.milliseconds)]] as const) : []),
  ]);
}

function contours(outer: number, holes: number): string {
  if (outer === 0) return 'none at this height';
  return holes === 0 ? `${count(outer)} outer` : `${count(outer)} outer, ${count(holes)} ${holes === 1 ? 'hole' : 'holes'}`;
}

/** The same number of decimals at every height of a model, so that the figure does not jump. */
function fixedHeight(z: number, bounds: Bounds): string {
  const decimals = Math.min(6, Math.max(0, 3 - Math.floor(Math.log10(diagonal(bounds) || 1))));
  return z.toFixed(decimals).replace('-', '−');
}
