/** Triangles that a texture moved, laid flat or tore, seen where they are. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { boxStl, together } from './models.mjs';
import { outside, picture } from './page.mjs';
import { served } from './site.mjs';
import { another, BOX, drag, makeTexture, show, withModel, withTexture } from './textures.mjs';

const site = served();

const figures = (page) => page.locator('#affected .figure').allTextContents();

describe('triangles across seams', () => {
  test('are counted, coloured, and looked at one place after the other', () =>
    withTexture(site, async (page) => {
      const [, triangles, moved] = (await page.textContent('[data-defect=across] .figure')).match(/^(\d+) triangles, (\d+) moved$/).map(Number);
      assert.ok(triangles <= 12 && moved <= triangles, `${triangles} of 12 triangles, ${moved} of them moved`);
      await show(page, 'charts');
      await show(page, 'textured');
      const plain = await picture(page);
      await page.click('[data-defect=across]');
      assert.equal(await page.getAttribute('[data-defect=across]', 'aria-pressed'), 'true');
      assert.ok(await page.isChecked('[data-item=textured]'));
      assert.ok(await page.isVisible('#affected #stepper'));
      const places = Number((await page.textContent('#defect-place')).replace('one', '1').match(/\d+/)[0]);
      const coloured = await picture(page);
      assert.notEqual(coloured, plain);
      await page.click('#defect-next');
      assert.equal(await page.textContent('#defect-place'), `1 of ${places}`);
      assert.notEqual(await picture(page), coloured, 'the camera is there');
      await page.click('#defect-hide');
      assert.ok(await page.isHidden('#stepper'));
      assert.equal(await page.evaluate(() => document.activeElement.dataset.defect), 'across');
    }));

  test('of a soup that was split are those of its parts, and go when it is mapped anew', () =>
    withModel(site, together(BOX, boxStl([10, 10, 10], [30, 20, 50])), async (page) => {
      await page.click('#texture-block details summary');
      await page.check('#texture-refine');
      await makeTexture(page);
      const parts = Number((await page.textContent('#texture-verdict-text')).match(/(?:of|All) (\d+)/)[1]);
      assert.ok(parts > 24, `${parts} parts of 24 triangles`);
      const plain = await picture(page);
      await page.click('[data-defect=across]');
      assert.notEqual(await picture(page), plain);
      const before = await figures(page);
      await another(page, () => drag(page, '#texture-offset', 50));
      assert.ok(await page.isHidden('#stepper'));
      assert.equal(await page.locator('#affected [aria-pressed=true]').count(), 0);
      assert.notDeepEqual(await figures(page), before);
    }));

  test('and places of defects have one list of steps, which is below the entry that is pressed; narrow pages hold it', () =>
    withModel(
      site,
      boxStl([0, 0, 0], [40, 30, 20], { without: [2, 3] }),
      async (page) => {
        await page.evaluate(() => (document.getElementById('check-block').open = true));
        await makeTexture(page);
        await page.click('[data-defect=holes]');
        assert.ok(await page.isVisible('#defects #stepper'));
        assert.ok(await page.isChecked('[data-item=model]'));
        await page.click('[data-defect=across]');
        assert.ok(await page.isVisible('#affected #stepper'));
        assert.equal(await page.getAttribute('[data-defect=holes]', 'aria-pressed'), 'false');
        assert.ok(!(await page.isChecked('[data-item=model]')));
        assert.deepEqual(await outside(page), []);
      },
      { width: 390, height: 844 },
    ));
});
