/** The keyboard, and the page at every width, in the light and in the dark. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { outside, sharedPage, withPage as onSite } from './page.mjs';
import { served } from './site.mjs';

const site = served();

const withPage = (options, work) => onSite(site, options, work);

describe('the keyboard', () => {
  const onPage = sharedPage(site);

  test('reaches every control, and each has a name and shows that it is reached', () =>
    onPage(async (page) => {
      const reached = new Set();
      const nameless = [];
      const unseen = [];
      for (let press = 0; press < 160; press++) {
        await page.keyboard.press('Tab');
        const { id, name, isSeen } = await page.evaluate(() => {
          const element = document.activeElement;
          const name = element.getAttribute('aria-label') || element.labels?.[0]?.textContent || element.textContent;
          // A radio button of a segmented control has its outline around its text.
          const isSeen = [element, element.nextElementSibling].some((part) => part && getComputedStyle(part).outlineStyle !== 'none');
          return { id: element.id || element.dataset.item || element.dataset.view, name: name.trim(), isSeen };
        });
        if (id) reached.add(id);
        if (id && !name) nameless.push(id);
        if (id && !isSeen) unseen.push(id);
      }
      assert.deepEqual([nameless, unseen], [[], []]);
      for (const id of ['theme', 'sample', 'choose', 'model', 'check', 'repair', 'voxel-resolution', 'voxelize', 'surface', 'offset', 'second-choose', 'print-density', 'prepare', 'canvas', 'fit', 'layer-slider', 'heat', 'distance']) {
        assert.ok(reached.has(id), `Tab reaches ${id}`);
      }
    }));

  test('moves the plane by single layers', () =>
    onPage(async (page) => {
      await page.focus('#layer-slider');
      await page.keyboard.press('ArrowRight');
      assert.equal(await page.textContent('#layer-out'), 'layer 156 of 309');
      assert.match(await page.getAttribute('#layer-slider', 'aria-valuetext'), /^layer 156 of 309, z 110\.7 millimetres$/);
    }));

  test('turns the view', () =>
    onPage(async (page) => {
      const axes = () => page.innerHTML('#axes');
      await page.focus('#canvas');
      const before = await axes();
      await page.keyboard.press('ArrowLeft');
      await page.waitForFunction((before) => document.getElementById('axes').innerHTML !== before, before);
    }));
});

describe('the layout', () => {
  test('fits 390 to 2560 px without scrolling sideways', () =>
    withPage({ width: 390, height: 844 }, async (page) => {
      await page.check('#heat');
      await page.waitForSelector('#legend:not([hidden])');
      for (const width of [390, 768, 1024, 1600, 2560]) {
        await page.setViewportSize({ width, height: 844 });
        const sideways = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
        assert.equal(sideways, 0, `${width} px`);
        assert.deepEqual(await outside(page), [], `${width} px`);
      }
    }));

  test('follows the system into the dark, and the button leads out', async () => {
    const context = await site.browser.newContext({ colorScheme: 'dark' });
    const page = await context.newPage();
    await page.goto(site.server.url);
    const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const dark = await paper();
    await page.click('#theme');
    const light = await paper();
    assert.ok(luminance(dark) < 40 && luminance(light) > 200, `${dark} and ${light}`);
    await page.reload();
    assert.equal(await paper(), light, 'the choice is remembered');
    await context.close();
  });
});

function luminance(colour) {
  const [red, green, blue] = colour.match(/\d+/g).map(Number);
  return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}
