/** Takes the picture of the README from the built page: `npm --prefix www run picture`. */
import { fileURLToPath } from 'node:url';
import { launch } from './browser.mjs';
import { openPage, slide } from './page.mjs';
import { serve } from './serve.mjs';

/** Low enough to meet the holes under the scan, where w is a fraction. */
const LAYER = 10;

const [browser, server] = await Promise.all([launch(), serve()]);
const page = await openPage(browser, server.url, { width: 1440, height: 810 });
await slide(page, '#layer-slider', LAYER);
await page.check('#heat');
await page.waitForFunction(() => document.querySelector('#plan-svg image'));
// The fine heat map follows the rough one.
await page.waitForTimeout(3000);
await page.locator('#heat').blur();
await page.screenshot({ path: fileURLToPath(new URL('../../www/readme.png', import.meta.url)) });
await browser.close();
await server.close();
