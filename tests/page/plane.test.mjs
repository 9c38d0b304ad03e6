/** The plane: its layer, and what it is coloured by. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { boxStl } from './models.mjs';
import { contourAt, dropFile, picture, sampleHeight, saved, settled, sharedPage, shows, slide, withModel } from './page.mjs';
import { served } from './site.mjs';

const site = served();

const BOX = boxStl([0, 0, 0], [40, 30, 20]);

describe('the plane', () => {
  const onPage = sharedPage(site);

  test('is saved as SVG', () =>
    onPage(async (page) => {
      const { name, bytes } = await saved(page, '#layer-download');
      assert.match(name, /^bunny-z.*\.svg$/);
      const text = bytes.toString('utf8');
      assert.match(text, /<svg[^>]*>/);
      assert.match(text, /<path|<polygon/);
    }));

  test('moves its contour, and follows a fast slider to its last place', () =>
    onPage(async (page) => {
      const before = await contourAt(page, sampleHeight(154));
      for (let index = 30; index <= 60; index++) await slide(page, '#layer-slider', index);
      const after = await contourAt(page, sampleHeight(60));
      assert.notEqual(after, before);
      assert.equal(await page.textContent('#layer-z'), 'z = 63.2 mm');
      await slide(page, '#layer-slider', 61);
      await contourAt(page, sampleHeight(61));
      await slide(page, '#layer-slider', 60);
      assert.equal(await contourAt(page, sampleHeight(60)), after, 'the same height gives the same contour');
    }));

  test('keeps its height when the layer height changes', () =>
    onPage(async (page) => {
      assert.equal(await page.textContent('#layer-out'), 'layer 61 of 309');
      await page.fill('#layer-height', '1');
      await page.press('#layer-height', 'Enter');
      assert.equal(await page.textContent('#layer-out'), 'layer 31 of 155');
      await page.fill('#layer-height', '-3');
      await page.press('#layer-height', 'Enter');
      assert.equal(await page.inputValue('#layer-height'), '1', 'a height that makes no sense is taken back');
    }));

  test('shows w as colours, 1 in the middle of a box and 0 beside it', () =>
    onPage(async (page) => {
      await dropFile(page, 'box.stl', BOX);
      await shows(page, '12');
      await settled(page);
      await page.check('#heat');
      await page.waitForSelector('#plan-svg image', { state: 'attached' });
      assert.deepEqual(await page.locator('#legend-ticks span').allTextContents(), ['1/2', '0', '1']);
      const box = await page.locator('#plan').boundingBox();
      const wAt = async (x, y) => {
        await page.mouse.move(box.x + x * box.width, box.y + y * box.height);
        return Number(/w (-?[\d.]+)/.exec(await page.textContent('#plan-readout'))[1]);
      };
      assert.ok(Math.abs((await wAt(0.5, 0.5)) - 1) < 0.01);
      assert.ok(Math.abs(await wAt(0.05, 0.5)) < 0.01);
      await page.uncheck('#heat');
      await page.waitForSelector('#plan-svg image', { state: 'detached' });
    }));
});

describe('signed distances', () => {
  test('colour the plane, with lines and a scale in mm, in the place of w', () =>
    withModel(site, BOX, async (page) => {
      await page.check('#heat');
      await page.waitForSelector('#legend:not([hidden])');
      const before = await picture(page);
      await page.check('#distance');
      await page.waitForSelector('#distance-legend:not([hidden])');
      assert.ok(!(await page.isChecked('#heat')), 'one colour at a time');
      await page.waitForSelector('#legend', { state: 'hidden' });
      assert.match(await page.textContent('#distance-title'), /^a line every \d+(\.\d+)? mm$/);
      const ticks = await page.locator('#distance-ticks span').allTextContents();
      assert.ok(ticks.includes('0') && ticks.some((tick) => tick.startsWith('−')) && ticks.some((tick) => tick.startsWith('+')), ticks.join(' '));
      assert.match(await page.getAttribute('#plan-svg .isoline.zero', 'd'), /^M.*L/);
      assert.notEqual(await picture(page), before);

      const box = await page.locator('#plan').boundingBox();
      const distanceAt = async (x, y) => {
        await page.mouse.move(box.x + x * box.width, box.y + y * box.height);
        return Number(/d (-?[\d.]+) mm/.exec(await page.textContent('#plan-readout'))[1]);
      };
      // The plane is in the middle of 20 mm; the plan's margin is 8 % of 40 mm.
      assert.ok(Math.abs((await distanceAt(0.5, 0.5)) + 10) < 0.3);
      assert.ok(Math.abs((await distanceAt(0.01, 0.5)) - 2.7) < 0.6);
      await page.uncheck('#distance');
      await page.waitForSelector('#distance-legend', { state: 'hidden' });
    }));
});
