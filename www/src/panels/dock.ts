import { followPlayback, play } from '../actions/playback.ts';
import { byId, paintSlider } from '../dom.ts';
import { count } from '../format.ts';
import type { Print } from '../print.ts';
import { layerCount, movesIn } from '../segments.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

/** Below the view, while it shows a print: up to where, and playing it. */
export function dock(store: Store<State>): void {
  const layer = byId<HTMLInputElement>('print-layer');
  const move = byId<HTMLInputElement>('print-move');
  const only = byId<HTMLInputElement>('print-only');
  const pace = byId<HTMLSelectElement>('print-pace');
  const button = byId('print-play');

  layer.addEventListener('input', () => {
    const { print } = store.state;
    if (print) store.set({ isPlaying: false, nozzle: { layer: layer.valueAsNumber, moves: movesIn(print.value.segments, layer.valueAsNumber) } });
  });
  move.addEventListener('input', () => store.set({ isPlaying: false, nozzle: { ...store.state.nozzle, moves: move.valueAsNumber } }));
  only.addEventListener('change', () => store.set({ onlyLayer: only.checked }));
  button.addEventListener('click', () => (store.state.isPlaying ? store.set({ isPlaying: false }) : play(store)));
  followPlayback(store, () => Number(pace.value));

  store.on(['print', 'visible', 'halves'], ({ print, visible, halves }) => {
    byId('print-dock').hidden = !print || !visible.print || halves;
    if (byId('print-dock').hidden && store.state.isPlaying) store.set({ isPlaying: false });
  });
  store.on(['isPlaying'], ({ isPlaying }) => {
    button.textContent = isPlaying ? 'Pause' : 'Play';
    button.setAttribute('aria-label', isPlaying ? 'Pause the print' : 'Play the print');
  });
  store.on(['print', 'nozzle'], ({ print, nozzle }) => {
    if (!print) return;
    const { segments } = print.value;
    show(layer, nozzle.layer, layerCount(segments) - 1, layerText(print.value, nozzle.layer));
    const moves = movesIn(segments, nozzle.layer);
    show(move, Math.floor(nozzle.moves), moves, `move ${count(Math.floor(nozzle.moves))} of ${count(moves)}`);
  });
}

function show(slider: HTMLInputElement, value: number, max: number, text: string): void {
  slider.max = String(max);
  slider.valueAsNumber = value;
  paintSlider(slider);
  slider.setAttribute('aria-valuetext', text);
  byId(`${slider.id}-out`).textContent = text;
}

/** The height is the nozzle's above the bed. */
function layerText({ layers, segments, gcode }: Print, layer: number): string {
  const height = Number((layers[layer].zTop + gcode.shift[2]).toFixed(3));
  return `layer ${count(layer + 1)} of ${count(layerCount(segments))}, ${height} mm`;
}
