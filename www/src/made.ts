import type { Item, State } from './state.ts';

/** What may be made of a model: where the one that is shown is in the state, its name, and the colour that it has in the view. */
export const MADE = {
  repaired: { slot: 'repair', label: 'Repaired', token: '--view-repaired' },
  combined: { slot: 'combined', label: 'Combined', token: '--view-front' },
  textured: { slot: 'texture', label: 'Textured', token: '--view-textured' },
  offset: { slot: 'offset', label: 'Offset', token: '--view-offset' },
  surface: { slot: 'surface', label: 'Surface', token: '--view-surface' },
  voxels: { slot: 'voxels', label: 'Voxels', token: '--view-voxels' },
  print: { slot: 'print', label: 'Print', token: '--print-outer-wall' },
} as const satisfies Partial<Record<Item, { slot: keyof State; label: string; token: string }>>;
export type Made = keyof typeof MADE;
export const ALL_MADE = Object.keys(MADE) as Made[];

/** What is drawn as a solid, in the place of the model. */
export const SOLIDS = ['voxels', 'surface', 'repaired', 'offset', 'combined', 'difference'] as const satisfies readonly Item[];
export type Solid = (typeof SOLIDS)[number];

export function isSolid(item: Item): item is Solid {
  return (SOLIDS as readonly Item[]).includes(item);
}

type Slot<M extends Made> = (typeof MADE)[M]['slot'];

/** One thing that was made. */
export type Making = { readonly [M in Made]: { readonly item: M; readonly made: NonNullable<State[Slot<M>]> } }[Made];

/** The same in the list of all that was made: it is shown, or can be shown again. */
export type Result = Making & { readonly id: number };

/** A number for one more. */
export function nextId(results: readonly Result[]): number {
  return 1 + Math.max(0, ...results.map(({ id }) => id));
}

/** What of the model is made is beside it when the view is split: what is shown, or what there is to be shown. A print has its own view. */
export function madeOf(state: State): Made | undefined {
  const there = ALL_MADE.filter((item) => item !== 'print' && state[MADE[item].slot] !== undefined);
  return there.find((item) => state.visible[item]) ?? there[0];
}

/** The state with a result in its place. */
export function withResult(state: State, { item, made }: Making): State {
  return { ...state, [MADE[item].slot]: made };
}

/** As it is called: the second surface is `Surface 2`. */
export function nameOf(result: Result, results: readonly Result[]): string {
  const label = labelOf(result);
  const alike = results.filter((other) => labelOf(other) === label);
  return alike.length > 1 ? `${label} ${alike.indexOf(result) + 1}` : label;
}

/** What it is called if there is no other like it. */
export function labelOf({ item, made: { value } }: Making): string {
  return 'kind' in value && value.kind === 'hollow' ? 'Hollow' : MADE[item].label;
}
