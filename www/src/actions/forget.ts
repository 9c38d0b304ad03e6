import { NOTHING_MADE } from '../state.ts';
import type { State } from '../state.ts';

/** Gives back what was made of the model, of which nothing is left then. */
export function forgotten({ repair, combined, texture }: State): typeof NOTHING_MADE {
  repair?.value.soup.free();
  combined?.value.soup.free();
  texture?.value.handle.free();
  return NOTHING_MADE;
}
