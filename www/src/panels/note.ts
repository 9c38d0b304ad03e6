import { byId } from '../dom.ts';
import { milliseconds, plural } from '../format.ts';
import { nameOf } from '../made.ts';
import type { Result } from '../made.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';
import { figureOf } from './results.ts';

/** What has happened last, in one line, which is read out: a model is open, a result is made, a job was cancelled. */
export function notes(store: Store<State>): void {
  store.on(['note'], ({ note = '' }) => {
    byId('note').textContent = note;
    byId('tagline').hidden = note !== '';
  });
  let shape: object | undefined;
  store.on(['model'], ({ model }) => {
    if (!model || model.shape === shape) return;
    shape = model.shape;
    store.set({ note: `${model.name}: ${plural(model.shape.count, model.shape.kind === 'soup' ? 'triangle' : 'point')}` });
  });
  let newest: Result | undefined;
  store.on(['results'], ({ results, job }) => {
    const last = results.at(-1);
    if (last === newest) return;
    newest = last;
    if (last && job) store.set({ note: `${nameOf(last, results)}: ${figureOf(last)}, ${milliseconds(last.made.milliseconds)}` });
  });
  store.on(['report'], ({ report, job }) => {
    if (report && job) store.set({ note: `Check: ${byId('verdict-text').textContent}` });
  });
}
