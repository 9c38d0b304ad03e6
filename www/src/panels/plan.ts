import type { Bounds, HeatMap } from 'fast-winding';
import { diagonal } from '../bounds.ts';
import { colourOf, spanOf } from '../colour.ts';
import { pathOf } from '../contour.ts';
import { distanceColour, isoline, levelsOf, scaleOf } from '../distances.ts';
import type { PlaneDistances } from '../distances.ts';
import { byId } from '../dom.ts';
import { niceBelow, significant } from '../format.ts';
import { valueAt, rectangleOf, paintMap } from '../plane-map.ts';
import type { PlaneMap } from '../plane-map.ts';
import type { Rgb } from '../ramp.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

/** Room around the model, as a part of its width. */
const MARGIN = 0.08;
/** Bounds of height over width, and of width over height. */
const TALLEST = 1.1;
const FLATTEST = 2;

/** The layer from above: contours as vectors, w or distances as colours under them, and their value under the pointer. */
export function planPanel(store: Store<State>): void {
  const svg = byId<SVGSVGElement>('plan-svg');
  const plan = byId('plan');
  plan.insertAdjacentHTML('beforeend', '<div class="plan-ruler" aria-hidden="true"><span></span><i></i></div>');
  const ruler = plan.querySelector<HTMLElement>('.plan-ruler')!;

  const showRuler = (): void => {
    const { model } = store.state;
    if (!model) return;
    const { width, height } = windowOf(model.bounds);
    const pixelsPerMillimetre = Math.min(plan.clientWidth / width, plan.clientHeight / height);
    const length = niceBelow(width / 4);
    ruler.querySelector('i')!.style.width = `${length * pixelsPerMillimetre}px`;
    ruler.querySelector('span')!.textContent = `${significant(length)} mm`;
  };
  new ResizeObserver(showRuler).observe(plan);

  store.on(['model', 'layer', 'heat', 'distances', 'visible'], (state) => {
    svg.innerHTML = drawing(state);
    plan.classList.toggle('heated', state.heat !== undefined || state.distances !== undefined);
    showRuler();
  });

  const readout = byId('plan-readout');
  svg.addEventListener('pointermove', (event) => {
    const matrix = svg.getScreenCTM();
    if (!store.state.model || !matrix) return;
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    readout.textContent = describe(store.state, x, -y);
  });
  svg.addEventListener('pointerleave', () => {
    readout.textContent = '';
  });
}

/** The part of the plane that is drawn, in SVG's coordinates (y down): the bounds with a margin, neither very tall nor very flat. */
function windowOf({ min, max }: Bounds): { x: number; y: number; width: number; height: number } {
  const margin = 2 * MARGIN * Math.max(max[0] - min[0], max[1] - min[1], 1e-9);
  const [across, along] = [max[0] - min[0] + margin, max[1] - min[1] + margin];
  const width = Math.max(across, along / TALLEST);
  const height = Math.max(along, across / FLATTEST);
  return { x: (min[0] + max[0] - width) / 2, y: -(min[1] + max[1] + height) / 2, width, height };
}

function drawing({ model, layer, heat, distances }: State): string {
  if (!model) return '';
  const { x, y, width, height } = windowOf(model.bounds);
  byId('plan-svg').setAttribute('viewBox', `${x} ${y} ${width} ${height}`);
  byId('plan').style.aspectRatio = `${width} / ${height}`;
  const { min, max } = model.bounds;
  const frame = `<rect class="frame" x="${min[0]}" y="${-max[1]}" width="${max[0] - min[0]}" height="${max[1] - min[1]}"/>`;
  const path = layer ? pathOf(layer.value) : '';
  const image = heat ? windingImage(heat.value) : distances ? distanceImage(distances.value) : '';
  return `${image}${frame}<path class="region" fill-rule="evenodd" d="${path}"/><path class="contour" data-z="${layer?.value.zSample ?? ''}" d="${path}"/>`;
}

function windingImage(map: HeatMap): string {
  const span = spanOf(map.values);
  return imageOf(map, (value) => colourOf(value, span));
}

/** The colours, and lines along which distances are equal. */
function distanceImage(map: PlaneDistances): string {
  const scale = scaleOf(map);
  const lines = levelsOf(scale).map((level) => `<path class="${level === 0 ? 'isoline zero' : 'isoline'}" data-level="${level}" d="${segmentsPath(isoline(map, level))}"/>`);
  return imageOf(map, (value) => distanceColour(value, scale)) + lines.join('');
}

function imageOf(map: PlaneMap, colour: (value: number) => Rgb): string {
  const { min, max } = rectangleOf(map);
  return `<image x="${min[0]}" y="${-max[1]}" width="${max[0] - min[0]}" height="${max[1] - min[1]}" preserveAspectRatio="none" href="${paintMap(map, colour).toDataURL()}"/>`;
}

/** Segments xyxy…, y pointing up turned to y pointing down. */
function segmentsPath(ends: readonly number[]): string {
  let path = '';
  for (let i = 0; i < ends.length; i += 4) path += `M${ends[i].toFixed(4)} ${(-ends[i + 1]).toFixed(4)}L${ends[i + 2].toFixed(4)} ${(-ends[i + 3]).toFixed(4)}`;
  return path;
}

function describe({ heat, distances, model }: State, x: number, y: number): string {
  const decimals = Math.max(0, 2 - Math.floor(Math.log10(diagonal(model!.bounds) || 1)));
  const place = `x ${x.toFixed(decimals)}  y ${y.toFixed(decimals)}`;
  const w = heat && valueAt(heat.value, x, y);
  if (w !== undefined) return `${place}  w ${w.toFixed(3)}`;
  const distance = distances && valueAt(distances.value, x, y);
  return distance === undefined ? place : `${place}  d ${distance.toFixed(decimals)} mm`;
}
