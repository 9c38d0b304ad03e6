import type { Bounds } from 'fast-winding';
import { pathOf } from '../contour.ts';
import { byId } from '../dom.ts';
import { niceBelow, significant } from '../format.ts';
import { heatAt, heatRectangle, paintHeat } from '../heat.ts';
import { diagonal } from '../state.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

/** Room around the model, as a part of its width. */
const MARGIN = 0.08;
/** Bounds of height over width, and of width over height. */
const TALLEST = 1.1;
const FLATTEST = 2;

/** The layer from above: contours as vectors, the heat map under them, and w under the pointer. */
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

  store.on(['model', 'layer', 'heat', 'visible'], (state) => {
    svg.innerHTML = drawing(state);
    plan.classList.toggle('heated', state.heat !== undefined);
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

function drawing({ model, layer, heat }: State): string {
  if (!model) return '';
  const { x, y, width, height } = windowOf(model.bounds);
  byId('plan-svg').setAttribute('viewBox', `${x} ${y} ${width} ${height}`);
  byId('plan').style.aspectRatio = `${width} / ${height}`;
  const { min, max } = model.bounds;
  const frame = `<rect class="frame" x="${min[0]}" y="${-max[1]}" width="${max[0] - min[0]}" height="${max[1] - min[1]}"/>`;
  const path = layer ? pathOf(layer.value) : '';
  const image = heat ? heatImage(heat.value) : '';
  return `${image}${frame}<path class="region" fill-rule="evenodd" d="${path}"/><path class="contour" data-z="${layer?.value.zSample ?? ''}" d="${path}"/>`;
}

function heatImage(map: Parameters<typeof paintHeat>[0]): string {
  const { min, max } = heatRectangle(map);
  return `<image x="${min[0]}" y="${-max[1]}" width="${max[0] - min[0]}" height="${max[1] - min[1]}" preserveAspectRatio="none" href="${paintHeat(map).toDataURL()}"/>`;
}

function describe({ heat, model }: State, x: number, y: number): string {
  const decimals = Math.max(0, 2 - Math.floor(Math.log10(diagonal(model!.bounds) || 1)));
  const place = `x ${x.toFixed(decimals)}  y ${y.toFixed(decimals)}`;
  const w = heat && heatAt(heat.value, x, y);
  return w === undefined ? place : `${place}  w ${w.toFixed(3)}`;
}
