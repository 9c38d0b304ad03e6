import type { Item, State } from './state.ts';

/** What may be made of a model, to be seen beside it. */
const MADE = ['repaired', 'combined', 'textured', 'offset', 'surface', 'voxels'] as const satisfies readonly Item[];
export type Made = (typeof MADE)[number];

export const MADE_LABELS: Record<Made, string> = {
  repaired: 'Repaired',
  combined: 'Combined',
  textured: 'Textured',
  offset: 'Offset',
  surface: 'Surface',
  voxels: 'Voxels',
};

/** What is shown of that, or what there is to be shown. */
export function madeOf({ repair, combined, texture, offset, surface, voxels, visible }: State): Made | undefined {
  const results = { repaired: repair, combined, textured: texture, offset, surface, voxels };
  const there = MADE.filter((item) => results[item] !== undefined);
  return there.find((item) => visible[item]) ?? there[0];
}
