/** The page for those who use it with the keyboard, with a screen reader, by touch, or without motion. */
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { describe, test } from 'node:test';
import { boxStl } from './models.mjs';
import { make, settled, slide, withModel } from './page.mjs';
import { served } from './site.mjs';

const site = served();

const AXE = createRequire(new URL('../../www/package.json', import.meta.url)).resolve('axe-core/axe.min.js');
/** Open, with a face that looks inward, so that there is something to tell. */
const BOX = boxStl([0, 0, 0], [40, 30, 20], { without: [2, 3], flipped: [4] });

/** What axe finds, as texts. */
async function violations(page) {
  if (!(await page.evaluate(() => 'axe' in window))) await page.addScriptTag({ path: AXE });
  return page.evaluate(async () => {
    const tags = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'];
    const { violations } = await window.axe.run(document, { runOnly: tags, resultTypes: ['violations'] });
    return violations.flatMap(({ id, nodes }) => nodes.map(({ target, failureSummary }) => `${id}: ${target} ${failureSummary}`));
  });
}

async function lightAndDark(page) {
  for (const colorScheme of ['light', 'dark']) {
    await page.emulateMedia({ colorScheme });
    await page.waitForFunction((scheme) => document.documentElement.dataset.theme === scheme, colorScheme);
    assert.deepEqual(await violations(page), [], colorScheme);
  }
}

describe('axe finds no fault', () => {
  test('with any tool, before and after its result, light and dark, wide and narrow', () =>
    withModel(site, BOX, async (page) => {
      await page.waitForSelector('#verdict:not([hidden])');
      await page.check('#heat');
      await lightAndDark(page);
      await page.click('[data-defect=holes]');
      for (const id of ['voxel', 'surface', 'offset']) await slide(page, `#${id}-resolution`, 32);
      for (const button of ['#repair', '#voxelize', '#surface', '#offset']) await make(page, button);
      await page.click('#voxel-compare:enabled');
      await page.waitForSelector('#comparison:not([hidden])');
      await page.selectOption('#second-shape', 'cube');
      await page.waitForSelector('#combine:enabled');
      await make(page, '#combine');
      await page.fill('#texture-exact', '4');
      await make(page, '#texture');
      await page.click('#seam-draw:enabled');
      await page.fill('#print-layer-height', '1');
      await page.press('#print-layer-height', 'Enter');
      await make(page, '#prepare');
      await page.click('#printer-fields >> xpath=.. >> summary');
      await lightAndDark(page);
      await page.setViewportSize({ width: 390, height: 844 });
      await page.fill('#offset-exact', '-30');
      await page.press('#offset-exact', 'Enter');
      await page.click('#offset:enabled');
      await page.waitForSelector('#problem:not([hidden])');
      await lightAndDark(page);
    }));
});

describe('what happens', () => {
  test('is told in one line: what is open, what is made, what was cancelled', () =>
    withModel(site, BOX, async (page) => {
      const note = () => page.textContent('#note');
      assert.equal(await page.getAttribute('#note', 'role'), 'status');
      assert.equal(await note(), 'box.stl: 10 triangles');
      await slide(page, '#surface-resolution', 32);
      await make(page, '#surface');
      assert.match(await note(), /^Surface: [\d,]+ triangles, [\d.]+ m?s$/);
      await slide(page, '#voxel-resolution', 384);
      await page.click('#voxelize:enabled');
      await page.waitForSelector('#job:not([hidden])');
      await page.keyboard.press('Escape');
      await page.waitForSelector('#job', { state: 'hidden' });
      assert.equal(await note(), 'Voxels: cancelled');
      await settled(page);
    }));
});

test('with a finger, what is to be touched is at least 44 px high', () =>
  withModel(
    site,
    BOX,
    async (page) => {
      const small = await page.evaluate(() =>
        [...document.querySelectorAll('button:not(.link), select, input[type=number], input[type=range]')]
          .filter((element) => element.getClientRects().length > 0 && element.getBoundingClientRect().height < 44)
          .map((element) => `${element.id}: ${element.getBoundingClientRect().height}`),
      );
      assert.deepEqual(small, []);
    },
    { width: 390, height: 844, hasTouch: true, isMobile: true },
  ));
