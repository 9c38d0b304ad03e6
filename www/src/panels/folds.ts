import { TOOLS } from '../address.ts';
import type { Tool } from '../address.ts';
import { byId } from '../dom.ts';
import type { State } from '../state.ts';
import { remember, remembered } from '../storage.ts';
import type { Store } from '../store.ts';

const KEY = 'fast-winding.open';
/** What is open before the person has opened or closed anything. */
const OPEN_AT_FIRST = ['check-block'];

/** The blocks of the tools, which fold: those that are open are remembered, and the one that the person is at is the page's tool. */
export function folds(store: Store<State>): void {
  const open = new Set(stored() ?? OPEN_AT_FIRST);
  const blocks = TOOLS.map((tool) => byId<HTMLDetailsElement>(`${tool}-block`));
  const folding = blocks.filter((block) => block.matches('.fold'));
  for (const block of folding) {
    block.open = open.has(block.id);
    block.addEventListener('toggle', () => {
      remember(KEY, folding.filter((other) => other.open).map(({ id }) => id));
      if (!block.open && block.id === `${store.state.tool}-block`) store.set({ tool: undefined });
    });
  }
  blocks.forEach((block, k) => {
    for (const event of ['focusin', 'click']) block.addEventListener(event, () => store.set({ tool: TOOLS[k] }));
  });
}

/** What keeps a block in sight. */
let following: ResizeObserver | undefined;

/** Opens a tool's block, and keeps it in sight while what is around it grows, as a report that comes later, until the person does anything. */
export function showTool(tool: Tool): void {
  const block = byId<HTMLDetailsElement>(`${tool}-block`);
  block.open = true;
  block.scrollIntoView();
  following?.disconnect();
  const own = (following = new ResizeObserver(() => block.scrollIntoView()));
  for (const neighbour of block.parentElement!.children) own.observe(neighbour);
  for (const event of ['pointerdown', 'keydown', 'wheel']) addEventListener(event, () => own.disconnect(), { capture: true, once: true, passive: true });
}

function stored(): string[] | undefined {
  const value = remembered(KEY);
  return Array.isArray(value) ? value.filter((id) => typeof id === 'string') : undefined;
}
