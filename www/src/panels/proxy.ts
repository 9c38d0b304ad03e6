import { suggestOffset } from '../actions/texture.ts';
import { sizeOf } from '../bounds.ts';
import { byId } from '../dom.ts';
import { length } from '../format.ts';
import type { Page } from '../page.ts';
import type { Mapping } from '../texture.ts';
import { lengthField } from './length-field.ts';
import type { LengthField } from './length-field.ts';
import { setSlider, slider } from './slider.ts';
import { enableWhenUsable } from './usable.ts';

/** The slider's far end, as a part of the model's longest side. */
const REACH = 0.15;

/** More cells are made only where they are asked for. */
const MOST_CELLS = 400;

/** How the proxy is made; `changed` is called when the person has let go of something. */
export function proxyFields(page: Page, changed: () => void): () => Mapping {
  const { store } = page;
  const offset = offsetField(page, changed);
  const [auto, both] = ['texture-auto', 'texture-both'].map((id) => byId<HTMLInputElement>(id));
  const [resolution, smoothing] = [slider('texture-resolution'), slider('texture-smoothing')];
  const adapt = (): void => {
    byId('texture-cells').hidden = auto.checked;
  };
  adapt();
  auto.addEventListener('change', adapt);
  for (const control of [auto, both, resolution, smoothing]) control.addEventListener('change', changed);
  const sides = (): Mapping['sides'] => (both.checked ? 'both' : 'outer');

  // A change that was cancelled, or failed, is taken back.
  store.on(['job', 'texture'], ({ job, texture }) => {
    if (job || !texture) return;
    const { mapping, report } = texture.value;
    offset.set(report.offset);
    both.checked = mapping.sides === 'both';
    setSlider(smoothing, mapping.smoothing!);
    if (!auto.checked) setSlider(resolution, mapping.resolution!);
  });

  const suggest = byId<HTMLButtonElement>('texture-suggest');
  const hint = byId('texture-suggested');
  enableWhenUsable(page, suggest, ({ model }) => model?.shape.kind === 'soup');
  suggest.addEventListener('click', () => {
    const { model } = store.state;
    void suggestOffset(page, sides()).then((least) => {
      if (least === undefined || store.state.model !== model) return;
      offset.set(upward(least));
      hint.textContent = `From ${length(least)} on one proxy holds all parts together.`;
      changed();
    });
  });
  store.on(['model'], ({ model }) => {
    hint.textContent = model ? `Usual is 3 % of the longest side, ${length(0.03 * longestSide(page))}. Smaller is closer to the model and takes longer.` : '';
  });
  return () => ({
    offset: offset.value(),
    // Given also where it is the usual one: a mapping keeps what it is not given.
    resolution: auto.checked ? Math.min(MOST_CELLS, Math.ceil((2 * longestSide(page)) / offset.value())) : resolution.valueAsNumber,
    smoothing: smoothing.valueAsNumber,
    sides: sides(),
  });
}

/** How far away the proxy is. */
function offsetField(page: Page, changed: () => void): LengthField {
  return lengthField(page, {
    exact: 'texture-exact',
    track: 'texture-offset',
    reach: () => REACH * longestSide(page),
    accepts: (millimetres) => millimetres > 0,
    startsAnew: true,
    changed,
  });
}

function longestSide({ store }: Page): number {
  const { model } = store.state;
  return model ? Math.max(...sizeOf(model.bounds)) : 1;
}

/** With three digits, not less than it was. */
function upward(millimetres: number): number {
  const unit = 10 ** (Math.floor(Math.log10(millimetres)) - 2);
  return Math.ceil(millimetres / unit) * unit;
}
