import type { Page } from '../page.ts';
import { allOf } from '../state.ts';
import type { Item } from '../state.ts';

/** Of the solid things only `item`: they fill the same space and would hide one another. */
export function only({ store }: Page, item: Item): Readonly<Record<Item, boolean>> {
  return { ...allOf(false), layer: store.state.visible.layer, defects: true, [item]: true };
}
