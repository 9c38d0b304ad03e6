import { after, before } from 'node:test';
import { launch } from './browser.mjs';
import { serve } from './serve.mjs';

/** A browser, and a server of the built page, for the tests of a file; both are there once these run. */
export function served() {
  const site = {};
  before(async () => {
    [site.browser, site.server] = await Promise.all([launch(), serve()]);
  });
  after(async () => {
    await site.browser?.close();
    await site.server?.close();
  });
  return site;
}
