import type { Page } from '../page.ts';
import type { Item } from '../state.ts';

/** Of the solid things only `item`: they fill the same space and would hide one another. */
export function only({ store }: Page, item: Item): Readonly<Record<Item, boolean>> {
  const none = { model: false, boundary: false, normals: false, voxels: false, surface: false, print: false };
  return { ...store.state.visible, ...none, [item]: true };
}
