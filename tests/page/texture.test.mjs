/** Textures of soups, by a proxy and field lines. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { SIDES, boxStl, sphereStl, sphereXyz, together } from './models.mjs';
import { dropFile, fact, openPage, picture, reachesSides, saved, settled, withModel as onPage } from './page.mjs';
import { serve } from './serve.mjs';
import { served } from './site.mjs';
import { another, atlas, BOX, distance, drag, idle, makeTexture, proxyTriangles, seamLength, show, withModel as withModelOn, withTexture as withTextureOn } from './textures.mjs';

const site = served();

const withModel = (...how) => withModelOn(site, ...how);
const withTexture = (...how) => withTextureOn(site, ...how);

describe('a texture', () => {
  test('of a sphere covers all its triangles, which is told in words and figures', () =>
    withModel(sphereStl(20, 12), async (page) => {
      assert.match(await page.textContent('#texture-suggested'), /3 % of the longest side, 1\.2 mm/);
      assert.ok(await page.isHidden('#texture-result'));
      const before = await picture(page);
      await makeTexture(page);
      assert.notEqual(await picture(page), before);
      assert.ok(await page.isChecked('input[name=texture-shown][value=textured]'));
      const verdict = await page.textContent('#texture-verdict-text');
      const doubtful = Number(verdict.match(/^(\d+) triangles? of 528 may reach beyond/)?.[1] ?? 0);
      assert.ok(doubtful <= 5, verdict);
      if (!doubtful) assert.equal(verdict, 'All 528 triangles have their part of the picture.');
      assert.equal(await page.getAttribute('#texture-verdict', 'data-rating'), doubtful ? 'caution' : 'good');
      assert.equal(await distance(page), 4);
      assert.match(await fact(page, 'texture-facts', 'Charts'), /^\d+, [\d.]+ mm of seams$/);
      const share = parseFloat(await fact(page, 'texture-facts', 'Of the picture used'));
      assert.ok(share > 20 && share <= 100, `${share} % of the picture`);
      const [mean, most] = (await fact(page, 'texture-facts', 'Stretched, mean and most')).split(', ').map(Number);
      assert.ok(mean >= 1 && mean < 1.5 && most >= mean, `stretched by ${mean}, ${most} at most`);
    }));

  test('is put into single charts where triangles lie across seams', () =>
    withTexture(async (page) => {
      assert.equal(await page.textContent('#texture-verdict-text'), 'All 12 triangles have their part of the picture.');
      assert.equal(await page.getAttribute('#texture-verdict', 'data-rating'), 'good');
      assert.match(await page.textContent('[data-defect=across] .figure'), /^(\d+) triangles, \1 moved$/);
      assert.ok(await page.isHidden('#texture-verdict-reasons'), 'there is nothing else to tell');
    }));

  test('shows its charts, and field lines that can be stopped', () =>
    withTexture(async (page) => {
      const textured = await picture(page);
      const plain = await atlas(page);
      await show(page, 'charts');
      const charts = await picture(page);
      assert.notEqual(charts, textured);
      assert.notEqual(await atlas(page), plain, 'the picture has the colours of the charts');
      assert.ok(await page.isHidden('#texture-flow-row'));
      await show(page, 'lines');
      assert.ok(await page.isChecked('[data-item=fieldLines]'));
      const moving = await picture(page);
      assert.notEqual(moving, charts);
      // In motion: it becomes another one, however long that takes.
      let tries = 0;
      while ((await picture(page)) === moving) assert.ok(tries++ < 50, 'nothing moves');
      await page.click('#texture-flow');
      const still = await picture(page);
      await page.waitForTimeout(400);
      assert.equal(await picture(page), still, 'they are at rest');
      assert.equal(await page.textContent('#texture-flow'), 'Set in motion');
    }));

  test('has field lines at rest for those who want less motion', () =>
    withModel(BOX, async (page) => {
      await page.emulateMedia({ reducedMotion: 'reduce' });
      await makeTexture(page);
      await show(page, 'lines');
      assert.equal(await page.textContent('#texture-flow'), 'Set in motion');
      const still = await picture(page);
      await page.waitForTimeout(400);
      assert.equal(await picture(page), still);
    }));

  test('is mapped anew when the proxy comes nearer, to the same lines', () =>
    withTexture(async (page) => {
      const lines = await fact(page, 'texture-facts', 'Field lines');
      await drag(page, '#texture-offset', 50);
      await page.waitForFunction(() => document.querySelector('#texture-facts dd').textContent.startsWith('3 mm'));
      await idle(page);
      assert.equal(await fact(page, 'texture-facts', 'Field lines'), lines);
      assert.equal(await page.inputValue('#texture-exact'), '3');
    }));

  test('has a proxy that is smoothed, for the same lines', () =>
    withTexture(async (page) => {
      await page.click('#texture-block details summary');
      const lines = await fact(page, 'texture-facts', 'Field lines');
      const [triangles, length] = [await proxyTriangles(page), await seamLength(page)];
      await another(page, () => drag(page, '#texture-smoothing', 10));
      assert.equal(await proxyTriangles(page), triangles, 'smoothing moves vertices alone');
      assert.notEqual(await seamLength(page), length);
      assert.equal(await fact(page, 'texture-facts', 'Field lines'), lines);
    }));

  test('has a proxy that goes in where its model is open, if that is wanted', () =>
    withModel(boxStl([0, 0, 0], [40, 30, 20], { without: SIDES.top }), async (page) => {
      await makeTexture(page, 2);
      const outer = await proxyTriangles(page);
      await page.click('#texture-block details summary');
      await another(page, () => page.check('#texture-both'));
      const both = await proxyTriangles(page);
      // Instead of a lid over the opening of 36 × 26 mm, the proxy has the inner sides of the walls, 18 mm high, and of the bottom.
      const box = 2 * (44 * 34 + 44 * 24 + 34 * 24);
      const ratio = (box + 2 * 18 * (36 + 26)) / box;
      assert.ok(Math.abs(both / outer / ratio - 1) < 0.05, `${both} triangles for two sides, ${outer} for one, whose areas are as ${ratio} to 1`);
    }));

  test('splits triangles that cross before, if that is wanted', () =>
    withModel(together(BOX, boxStl([10, 10, 10], [30, 20, 50])), async (page) => {
      const textured = async () => parseInt(/(?:of|All) ([\d,]+)/.exec(await page.textContent('#texture-verdict-text'))[1].replaceAll(',', ''), 10);
      await makeTexture(page);
      assert.equal(await textured(), 24);
      await page.click('#texture-block details summary');
      await page.check('#texture-refine');
      await another(page, () => page.click('#texture:enabled'));
      assert.ok((await textured()) > 24, `${await textured()} triangles`);
    }));

  test('stays as it was when another mapping is cancelled', () =>
    withTexture(async (page) => {
      const [facts, view] = [await page.textContent('#texture-facts'), await picture(page)];
      await page.click('#texture-block details summary');
      // At once: the mapping would not take longer than a key.
      await page.evaluate(() => {
        document.getElementById('texture-both').click();
        document.body.dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape', bubbles: true }));
      });
      await idle(page);
      await page.fill('#texture-exact', '0.3');
      await page.press('#texture-exact', 'Enter');
      await page.waitForSelector('#job:not([hidden])');
      await page.keyboard.press('Escape');
      await idle(page);
      assert.equal(await page.textContent('#note'), 'Texture: cancelled');
      assert.equal(await page.textContent('#texture-facts'), facts);
      assert.equal(await page.inputValue('#texture-exact'), '4');
      assert.ok(!(await page.isChecked('#texture-both')));
      assert.equal(await picture(page), view);
    }));

  test('is wholly in view when the view is fitted, with its proxy while that is shown', () =>
    withModel(BOX, async (page) => {
      await makeTexture(page, 15);
      await page.uncheck('[data-item=layer]');
      await show(page, 'charts');
      assert.ok(await reachesSides(page), 'the view is of the model, which the proxy is far larger than');
      await page.click('[data-view=fit]');
      assert.ok(!(await reachesSides(page)));
    }));

  test('is made, mapped anew and cancelled on one thread too', async () => {
    const plain = await serve({ isolated: false });
    try {
      const work = async (page) => {
        await makeTexture(page);
        assert.equal(await page.evaluate(() => crossOriginIsolated), false);
        await another(page, () => drag(page, '#texture-offset', 50));
        assert.equal(await distance(page), 3);
        await page.fill('#texture-exact', '0.3');
        await page.press('#texture-exact', 'Enter');
        await page.waitForSelector('#job:not([hidden])');
        await page.keyboard.press('Escape');
        await idle(page);
        assert.equal(await distance(page), 3);
        await another(page, () => drag(page, '#texture-offset', 80));
        assert.equal(await distance(page), 4.8);
        assert.equal((await saved(page, '#texture-download')).name, 'box-textured.glb');
      };
      await onPage({ ...site, server: plain }, BOX, work, { unfolded: ['texture-block'] });
    } finally {
      await plain.close();
    }
  });

  test('has the least distance suggested that one proxy needs', () =>
    withModel(BOX, async (page) => {
      await page.click('#texture-suggest:enabled');
      await page.waitForFunction(() => document.getElementById('texture-suggested').textContent.startsWith('From'));
      // A closed box is in one piece at the least distance that is tried, 1/80 of its longest side.
      assert.equal(await page.inputValue('#texture-exact'), '0.5');
    }));

  test('is none of points, which is told', async () => {
    const page = await openPage(site.browser, site.server.url, { unfolded: ['texture-block'] });
    try {
      await dropFile(page, 'points.xyz', sphereXyz(500, 10));
      await page.waitForSelector('#texture-cloud:not([hidden])');
      assert.ok(await page.isDisabled('#texture'));
    } finally {
      await page.context().close();
    }
  });

  test('that is cancelled leaves the page as it was', async () => {
    const page = await openPage(site.browser, site.server.url, { unfolded: ['texture-block'] });
    try {
      await page.click('#texture:enabled');
      await page.waitForSelector('#job:not([hidden])');
      await page.keyboard.press('Escape');
      await idle(page);
      assert.ok(await page.isHidden('#texture-result'));
      assert.ok(await page.isHidden('#problem'));
      assert.deepEqual(page.errors, []);
    } finally {
      await page.context().close();
    }
  });

  test('goes with the model that it is of', () =>
    withTexture(async (page) => {
      await dropFile(page, 'other.stl', boxStl([0, 0, 0], [10, 10, 10]));
      await page.waitForSelector('#texture-result', { state: 'hidden' });
      await settled(page);
      assert.equal(await page.locator('[data-item=textured]').isVisible(), false);
    }));
});
