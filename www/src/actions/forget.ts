import { NOTHING_MADE } from '../state.ts';
import type { State } from '../state.ts';

/** Gives back what was made of the model, of which nothing is left then. */
export function forgotten({ repair, combined }: State): typeof NOTHING_MADE {
  repair?.value.soup.free();
  combined?.value.soup.free();
  return NOTHING_MADE;
}
