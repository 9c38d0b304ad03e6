/** The page's address follows what is shown, and what is shown follows the address. */
import { SAMPLES } from '../../samples/catalogue.ts';
import { addressOf, hashOf, sampleNamed } from '../address.ts';
import type { Address, Tool } from '../address.ts';
import { stem } from '../download.ts';
import { keptFile } from '../kept.ts';
import type { Page, Source } from '../page.ts';
import type { Problem } from '../problem.ts';
import { keptSource, open, sampleSource } from './open.ts';

/** Opens what the address says, and goes on following it. Another model is a step back in the browser's history; another tool is none. */
export async function followAddress(page: Page, showTool: (tool: Tool) => void): Promise<void> {
  const { store } = page;
  let latest: Address | undefined;
  /** The address is given and is not to be written meanwhile. */
  const go = async (address: Address): Promise<void> => {
    latest = address;
    store.set({ tool: address.tool });
    if (!isShown(page, address)) await openNamed(page, address);
    if (latest !== address) return;
    if (address.tool) showTool(address.tool);
    latest = undefined;
    write(page, 'replaceState');
  };
  addEventListener('popstate', () => void go(addressOf(location.hash)));
  await go(addressOf(location.hash));
  store.on(['model', 'tool'], () => {
    if (!latest) write(page, isShown(page, addressOf(location.hash)) ? 'replaceState' : 'pushState');
  });
}

/** While nothing is shown, the address stays as it is. */
function write(page: Page, how: 'pushState' | 'replaceState'): void {
  if (!page.source) return;
  const hash = hashOf({ ...namesOf(page.source), tool: page.store.state.tool });
  if (hash !== location.hash) history[how](null, '', hash);
}

function namesOf(source?: Source): Address {
  if (!source) return {};
  return source.sample === undefined ? { file: source.id } : { sample: stem(source.sample) };
}

/** An address that names nothing is of whatever is shown. */
function isShown({ source, store }: Page, { sample, file }: Address): boolean {
  if (!source || !store.state.model) return false;
  const names = namesOf(source);
  return (sample === undefined && file === undefined) || (names.sample === sample && names.file === file);
}

async function openNamed(page: Page, address: Address): Promise<void> {
  const found = await sourceNamed(address);
  // What is shown stays, if there is anything.
  if ('detail' in found && !page.store.state.model) await open(page, sampleSource(SAMPLES[0].file));
  if ('detail' in found) page.store.set({ problem: found });
  else await open(page, found);
}

async function sourceNamed({ sample, file }: Address): Promise<Source | Problem> {
  if (file !== undefined) {
    const kept = await keptFile(file);
    return kept ? keptSource(kept) : { title: 'The file is not kept in this browser', detail: 'Choose it again, or drop it on the page.' };
  }
  const named = sample === undefined ? SAMPLES[0].file : sampleNamed(sample);
  return named ? sampleSource(named) : { title: `There is no sample ${sample}`, detail: 'The menu has all there are.' };
}
