import { forgetAll, keep } from '../kept.ts';
import { isSame } from '../page.ts';
import type { Page, Source } from '../page.ts';

/** Keeps each file that is opened in the browser, for when the page is loaded again; a sample need not be. */
export function followFiles(page: Page): void {
  const { store } = page;
  let seen: Source | undefined;
  store.on(['model'], () => {
    const { source } = page;
    if (!source || isSame(source, seen)) return;
    seen = source;
    store.set({ kept: undefined });
    if (source.sample === undefined) void keepSource(page, source);
  });
}

async function keepSource(page: Page, source: Source): Promise<void> {
  const { id, name, unit } = source;
  const content = async (): Promise<Blob> => new Blob([(await source.read(new AbortController().signal)) as Uint8Array<ArrayBuffer>]);
  const isKept = await content().then((content) => keep({ id, name, unit, content }), () => false);
  if (isSame(page.source, source)) page.store.set({ kept: isKept });
}

/** Forgets all files, and what was made of any model. */
export async function forgetKept({ store }: Page): Promise<void> {
  await forgetAll();
  store.set({ kept: false });
}
