import { measurePoints, orient } from '../actions/points.ts';
import type { Method } from '../actions/points.ts';
import { byId } from '../dom.ts';
import { significant } from '../format.ts';
import { rangeOf, shadeOf } from '../measure.ts';
import type { Page } from '../page.ts';
import { paintScale } from '../ramp.ts';
import type { PointMeasure, State } from '../state.ts';
import type { Store } from '../store.ts';

const UNITS = { area: 'mm²', noise: 'mm' } as const;

/** Estimating normals of a cloud, and the colours of its points. */
export function pointControls(page: Page): void {
  const method = byId<HTMLSelectElement>('orient-method');
  byId('orient').addEventListener('click', () => void orient(page, method.value as Method));
  const quantity = byId<HTMLSelectElement>('measure');
  quantity.addEventListener('change', () => {
    void measurePoints(page, (quantity.value || undefined) as PointMeasure['quantity'] | undefined);
  });
  page.store.on(['model', 'measure', 'job'], ({ model, measure, job }) => {
    byId('measure-field').hidden = model?.shape.kind !== 'cloud';
    quantity.disabled = job !== undefined;
    quantity.options.namedItem('measure-area')!.disabled = !model?.oriented;
    if (!job) quantity.value = measure?.quantity ?? '';
  });
}

/** The scale of the points' colours. */
export function measureLegend(store: Store<State>): void {
  store.on(['measure'], ({ measure }) => {
    byId('measure-legend').hidden = !measure;
    if (!measure) return;
    const range = rangeOf(measure.values);
    paintScale(byId<HTMLCanvasElement>('measure-bar'), range, (value) => shadeOf(value, range));
    byId('measure-low').textContent = significant(range.low, 2);
    byId('measure-high').textContent = `${significant(range.high, 2)} ${UNITS[measure.quantity]}`;
  });
}
