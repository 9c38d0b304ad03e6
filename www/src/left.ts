/** How a model was left: which of its results were shown, and how, for when they are there again. */
import { ALL_MADE, MADE } from './made.ts';
import type { Result } from './made.ts';
import type { Placement } from './placement.ts';
import { endOf } from './segments.ts';
import { allOf } from './state.ts';
import type { Item, State } from './state.ts';
import type { Seam, Texturing } from './texture.ts';

export interface Left {
  readonly visible: State['visible'];
  readonly halves: boolean;
  /** Of the second model. */
  readonly placement: Placement;
  /** Of results, by what they are kept as: those that have the places of their kinds, and the one that is on the left. */
  readonly inPlace: readonly string[];
  readonly against?: string;
  /** Seams that the texture's charts are not cut along yet. */
  readonly uncut?: readonly Seam[];
}

export function leftOf(state: State, idOf: (result: Result) => string | undefined): Left {
  const { visible, halves, placement, results, against, texture, seams } = state;
  const inPlace = results.filter(({ item, made }) => state[MADE[item].slot] === made).flatMap((result) => idOf(result) ?? []);
  const uncut = texture && texture.value.seams !== seams ? seams : undefined;
  return { visible, halves, placement, inPlace, against: against && idOf(against), uncut };
}

/** The same for a texture, when it is there again; how it is shown, only as long as nothing else was chosen. */
export function asTextureLeft({ seams }: Texturing, left: Left | undefined, isUntouched: boolean): Partial<State> {
  const shown = left && isUntouched ? { visible: { ...allOf(false), ...left.visible }, halves: left.halves } : {};
  return { seams: left?.uncut ?? seams, ...shown };
}

/** The state with results again, and with what they were kept as; what was made meanwhile stays as it is shown. */
export function asLeft(state: State, kept: ReadonlyMap<Result, string>, left: Left | undefined): Partial<State> {
  const results = [...kept.keys()];
  const patch: Partial<State> = { results: [...results, ...state.results] };
  for (const item of ALL_MADE) {
    const { slot } = MADE[item];
    const alike = results.filter((result) => result.item === item);
    const first = alike.find((result) => left?.inPlace.includes(kept.get(result)!)) ?? alike.at(-1);
    if (first && !state[slot]) Object.assign(patch, { [slot]: first.made });
  }
  if (patch.print) patch.nozzle = endOf(patch.print.value.segments);
  if (state.results.length > 0) return patch;
  const against = results.find((result) => left?.against !== undefined && kept.get(result) === left.against);
  return { ...patch, against, halves: left?.halves ?? false, visible: visibleOf({ ...state, ...patch }, left) };
}

/** Without what is there no longer; there is always something to be seen. */
function visibleOf(state: State, left: Left | undefined): State['visible'] {
  if (!left) return { ...allOf(false), model: true, boundary: true, layer: true, defects: true };
  const visible: Record<Item, boolean> = { ...allOf(false), ...left.visible };
  const isSeen = visible.model || ALL_MADE.some((item) => visible[item] && state[MADE[item].slot]);
  return isSeen ? visible : { ...visible, model: true, boundary: true };
}
