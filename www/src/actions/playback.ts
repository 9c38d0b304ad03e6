import type { Print } from '../print.ts';
import { advanced, endOf, isAtEnd, movesIn } from '../segments.ts';
import type { State } from '../state.ts';
import type { Store } from '../store.ts';

/** A page that was out of sight does not catch up. */
const LONGEST_STEP_SECONDS = 0.1;

/** Moves the nozzle along the print while it plays; `pace` says how many times as fast as the printer. */
export function followPlayback(store: Store<State>, pace: () => number): void {
  let last: number | undefined;
  const step = (now: number): void => {
    const { print, nozzle, isPlaying } = store.state;
    if (!print || !isPlaying) return void (last = undefined);
    const seconds = Math.min(LONGEST_STEP_SECONDS, (now - (last ?? now)) / 1000);
    last = now;
    const next = advanced(print.value.segments, nozzle, seconds * pace() * speedOf(print.value));
    store.set({ nozzle: next, isPlaying: !isAtEnd(print.value.segments, next) });
    requestAnimationFrame(step);
  };
  store.on(['isPlaying'], ({ isPlaying }) => {
    if (isPlaying && last === undefined) requestAnimationFrame(step);
  });
}

/** Plays on from where the nozzle is; from the start of its layer if that is complete, or of a print that is. */
export function play(store: Store<State>): void {
  const { print, nozzle, onlyLayer } = store.state;
  if (!print) return;
  const { segments } = print.value;
  const isComplete = nozzle.moves >= movesIn(segments, nozzle.layer);
  const layer = !onlyLayer && nozzle.layer === endOf(segments).layer ? 0 : nozzle.layer;
  store.set({ isPlaying: true, ...(isComplete ? { nozzle: { layer, moves: 0 } } : {}) });
}

/** Millimetres a second, on average. */
function speedOf({ segments, gcode }: Print): number {
  const total = segments.lengths.reduce((sum, length) => sum + length, 0);
  return total / Math.max(1e-9, gcode.estimate.seconds);
}
