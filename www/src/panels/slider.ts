import { sizeOf } from '../bounds.ts';
import { byId, paintSlider } from '../dom.ts';
import { count } from '../format.ts';
import type { State } from '../state.ts';

/** A slider whose value is written beside it. */
export function slider(id: string): HTMLInputElement {
  const input = byId<HTMLInputElement>(id);
  input.addEventListener('input', () => show(input));
  show(input);
  return input;
}

/** Sets such a slider, without a word to those who listen. */
export function setSlider(input: HTMLInputElement, value: number): void {
  input.valueAsNumber = value;
  show(input);
}

function show(input: HTMLInputElement): void {
  byId(`${input.id}-out`).textContent = input.value;
  paintSlider(input);
}

/** How many cubic cells a resolution along the longest side means for the model. */
export function cells({ model }: State, resolution: number): string {
  if (!model) return '';
  const sides = sizeOf(model.bounds);
  const cell = Math.max(...sides) / resolution;
  const counts = sides.map((side) => Math.max(1, Math.ceil(side / cell - 1e-9)));
  return `${counts.map(count).join(' × ')} cells of ${cell.toPrecision(3)} mm`;
}
