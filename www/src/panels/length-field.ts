import { byId, paintSlider } from '../dom.ts';
import type { Page } from '../page.ts';

/** Millimetres as a number, and a slider for them that goes as far as makes sense for the model. */
export interface LengthField {
  value(): number;
  set(millimetres: number): void;
}

export interface LengthFieldOptions {
  /** The ids of the number and of the slider, which has percents of the reach. */
  exact: string;
  track: string;
  /** Millimetres at the slider's end. */
  reach(): number;
  accepts(millimetres: number): boolean;
  /** Whether the slider goes back to where it was at first when another model comes; otherwise it stays, and the number follows. */
  startsAnew: boolean;
  /** Called when the person has let go. */
  changed?(): void;
}

export function lengthField({ store }: Page, { exact, track, reach, accepts, startsAnew, changed }: LengthFieldOptions): LengthField {
  const number = byId<HTMLInputElement>(exact);
  const slider = byId<HTMLInputElement>(track);
  const atFirst = slider.value;
  const say = (): void => {
    slider.setAttribute('aria-valuetext', `${number.value} millimetres`);
    paintSlider(slider);
  };
  const follow = (): void => {
    number.value = tidy((slider.valueAsNumber / 100) * reach());
    say();
  };
  const lead = (): void => {
    slider.valueAsNumber = (100 * number.valueAsNumber) / reach();
    say();
  };
  slider.addEventListener('input', follow);
  slider.addEventListener('change', () => changed?.());
  number.addEventListener('change', () => {
    if (!accepts(number.valueAsNumber)) return follow();
    lead();
    changed?.();
  });
  let shape = store.state.model?.shape;
  store.on(['model'], ({ model }) => {
    if (model?.shape === shape && number.value) return;
    shape = model?.shape;
    if (startsAnew) slider.value = atFirst;
    follow();
  });
  const set = (millimetres: number): void => {
    number.value = tidy(millimetres);
    lead();
  };
  return { value: () => number.valueAsNumber, set };
}

/** A length with three digits, as fields have it. */
export function tidy(millimetres: number): string {
  return String(Number(millimetres.toPrecision(3)));
}
