import type { ProxyGeometry } from 'fast-winding';
import { byId, token } from '../dom.ts';
import { plural } from '../format.ts';
import { checker } from '../picture.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';
import { hueOf, outlinesOf } from '../texture.ts';

/** How much of the charts' colours lies over the picture, while the view shows them. */
const TINT = 0.75;

/** The texture as a picture, with the outlines of the charts; in the charts' colours while the view shows these. */
export function atlasView(store: Store<State>): void {
  const canvas = byId<HTMLCanvasElement>('atlas');
  const paint = (): void => {
    const { texture } = store.state;
    if (!texture || canvas.clientWidth === 0) return;
    const side = Math.round(canvas.clientWidth * Math.min(2, devicePixelRatio));
    if (canvas.width !== side) canvas.width = canvas.height = side;
    draw(canvas.getContext('2d')!, side, texture.value.proxy, store.state);
    const charts = plural(texture.value.report.charts, 'chart');
    canvas.setAttribute('aria-label', `The picture with the outlines of ${charts}`);
    byId('atlas-note').textContent = `${charts}, as large as what ${texture.value.report.charts === 1 ? 'it shows' : 'they show'}`;
  };
  new ResizeObserver(paint).observe(canvas);
  store.on(['texture', 'picture', 'visible'], paint);
}

function draw(context: CanvasRenderingContext2D, side: number, proxy: ProxyGeometry, state: State): void {
  context.clearRect(0, 0, side, side);
  context.drawImage((state.picture ?? checker()).canvas, 0, 0, side, side);
  if (state.visible.proxy) tint(context, side, proxy);
  const outline = outlinesOf(proxy);
  const path = new Path2D();
  for (let k = 0; k < outline.length; k += 4) {
    path.moveTo(outline[k] * side, (1 - outline[k + 1]) * side);
    path.lineTo(outline[k + 2] * side, (1 - outline[k + 3]) * side);
  }
  context.lineJoin = context.lineCap = 'round';
  for (const [colour, width] of [['#ffffff', side / 130], [token('--view-seam'), side / 300]] as const) {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.stroke(path);
  }
}

function tint(context: CanvasRenderingContext2D, side: number, { uvs, charts }: ProxyGeometry): void {
  const paths = new Map<number, Path2D>();
  charts.forEach((chart, triangle) => {
    const path = paths.get(chart) ?? new Path2D();
    paths.set(chart, path);
    for (let k = 0; k < 3; k++) {
      const [x, y] = [uvs[6 * triangle + 2 * k] * side, (1 - uvs[6 * triangle + 2 * k + 1]) * side];
      if (k === 0) path.moveTo(x, y);
      else path.lineTo(x, y);
    }
    path.closePath();
  });
  context.globalAlpha = TINT;
  for (const [chart, path] of paths) {
    context.fillStyle = `hsl(${Math.round(360 * hueOf(chart))} 42% ${chart % 2 ? 60 : 70}%)`;
    context.fill(path);
  }
  context.globalAlpha = 1;
}
