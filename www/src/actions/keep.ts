import { forgetFiles, keep } from '../kept.ts';
import type { Page, Source } from '../page.ts';

/** Keeps each file that is opened in the browser, for when the page is loaded again; a sample need not be. */
export function followFiles(page: Page): void {
  const { store } = page;
  let seen: Source | undefined;
  store.on(['model'], () => {
    const { source } = page;
    if (!source || source === seen) return;
    seen = source;
    store.set({ kept: undefined });
    if (source.sample === undefined) void keepSource(page, source);
  });
}

async function keepSource(page: Page, source: Source): Promise<void> {
  const { id, name, unit } = source;
  const content = async (): Promise<Blob> => new Blob([(await source.read(new AbortController().signal)) as Uint8Array<ArrayBuffer>]);
  const isKept = await content().then((content) => keep({ id, name, unit, content }), () => false);
  if (page.source === source) page.store.set({ kept: isKept });
}

export async function forgetKept({ store }: Page): Promise<void> {
  await forgetFiles();
  store.set({ kept: false });
}
