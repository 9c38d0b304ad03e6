import { adopt } from '../actions/adopt.ts';
import { makeHollow, makeOffset } from '../actions/offset.ts';
import type { Cells } from '../actions/offset.ts';
import { saveMesh } from '../actions/save.ts';
import { boundsOf, diagonal, sizeOf } from '../bounds.ts';
import { byId, setFacts } from '../dom.ts';
import { count, milliseconds, size, volume } from '../format.ts';
import type { Page } from '../page.ts';
import { volumeOf } from '../results.ts';
import type { Offset } from '../results.ts';
import type { Timed } from '../state.ts';
import { lengthField, tidy } from './length-field.ts';
import { saver } from './saver.ts';
import { slider } from './slider.ts';
import { enableWhenUsable, reveal } from './usable.ts';

/** The slider's ends, as a part of the model's diagonal. */
const REACH = 0.1;
/** Walls at first, as a part of it. */
const WALLS = 0.02;

/** Surfaces at a distance, and hollow models. */
export function offsetPanel(page: Page): void {
  const { store } = page;
  const distance = lengthField(page, {
    exact: 'offset-exact',
    track: 'offset-distance',
    reach: () => REACH * (store.state.model ? diagonal(store.state.model.bounds) : 1),
    accepts: Number.isFinite,
    startsAnew: false,
  });
  const resolution = slider('offset-resolution');
  const sharp = byId<HTMLInputElement>('offset-sharp');
  const [thickness, drain] = ['hollow-thickness', 'hollow-drain'].map((id) => byId<HTMLInputElement>(id));
  const cells = (): Cells => ({ resolution: resolution.valueAsNumber, isSharp: sharp.checked });

  byId('offset').addEventListener('click', () => {
    if (Number.isFinite(distance.value())) void makeOffset(page, distance.value(), cells());
  });
  byId('hollow').addEventListener('click', () => {
    if (thickness.valueAsNumber > 0) void makeHollow(page, thickness.valueAsNumber, drain.valueAsNumber || 0, cells());
  });
  enableWhenUsable(page, byId<HTMLButtonElement>('offset'));
  enableWhenUsable(page, byId<HTMLButtonElement>('hollow'), ({ model }) => model?.shape.kind === 'soup');
  let shape = store.state.model?.shape;
  store.on(['model'], ({ model }) => {
    if (!model || model.shape === shape) return;
    shape = model.shape;
    thickness.value = tidy(WALLS * diagonal(model.bounds));
    drain.value = '0';
  });

  byId('offset-use').addEventListener('click', () => {
    const offset = store.state.offset?.value;
    if (offset) void adopt(page, offset.mesh, offset.kind);
  });
  enableWhenUsable(page, byId<HTMLButtonElement>('offset-use'), ({ offset }) => offset !== undefined);
  saver(page, 'offset-download', ({ offset }) => offset !== undefined, (format) => {
    const offset = store.state.offset?.value;
    if (offset) void saveMesh(page, offset.mesh, offset.kind, format);
  });
  store.on(['offset'], (state) => {
    const { offset } = state;
    byId('offset-result').hidden = !offset;
    setFacts(byId('offset-facts'), offset ? factsOf(offset) : []);
    if (offset) reveal(state, 'offset-result');
  });
}

function factsOf({ value: { mesh }, milliseconds: time }: Timed<Offset>): [string, string][] {
  return [
    ['Triangles', count(mesh.indices.length / 3)],
    ['Size', size(sizeOf(boundsOf(mesh.positions)))],
    ['Volume', volume(volumeOf(mesh))],
    ['Computed', milliseconds(time)],
  ];
}
