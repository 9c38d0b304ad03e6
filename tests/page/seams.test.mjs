/** Charts of a texture, and the seams that are drawn for them. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { picture } from './page.mjs';
import { served } from './site.mjs';
import { another, clickView, drag, drawSeam, idle, ON_TOP, seamLength, withTexture as withTextureOn } from './textures.mjs';

const site = served();

const withTexture = (...how) => withTextureOn(site, ...how);

describe('charts', () => {
  test('are told to be stale when they are to turn by another angle, until they are laid flat again', () =>
    withTexture(async (page) => {
      assert.ok(await page.isHidden('#seam-stale'));
      await drag(page, '#texture-cone', 30);
      assert.ok(await page.isVisible('#seam-stale'));
      await another(page, () => page.click('#flatten:enabled'));
      assert.ok(await page.isHidden('#seam-stale'));
    }));
});

describe('seams', () => {
  test('are drawn by two clicks, listed, taken back, and cut the charts', () =>
    withTexture(async (page) => {
      const before = await seamLength(page);
      await page.click('#seam-draw:enabled');
      assert.equal(await page.getAttribute('#seam-draw', 'aria-pressed'), 'true');
      assert.ok(await page.isChecked('input[name=texture-shown][value=charts]'));
      const charts = await picture(page);
      await drawSeam(page, ...ON_TOP);
      assert.match(await page.textContent('#seam-list li'), /^Seam 1, [\d.]+ mm/);
      assert.notEqual(await picture(page), charts, 'the seam is drawn');
      assert.ok(await page.isVisible('#seam-stale'));
      await page.click('#seam-undo');
      assert.equal(await page.locator('#seam-list li').count(), 0);
      await drawSeam(page, ...ON_TOP);
      await page.click('#flatten:enabled');
      await page.waitForSelector('#seam-stale', { state: 'hidden' });
      await idle(page);
      const after = await seamLength(page);
      assert.ok(after > before, `${after} mm of seams, ${before} mm without the one that was drawn`);
      await page.click('#seam-list button');
      assert.ok(await page.isVisible('#seam-stale'));
      await page.click('#seam-draw:enabled');
      assert.equal(await page.getAttribute('#seam-draw', 'aria-pressed'), 'false');
    }));

  test('are led on from their ends, in one piece', () =>
    withTexture(async (page) => {
      await page.click('#seam-draw:enabled');
      await drawSeam(page, ...ON_TOP);
      const length = async () => parseFloat((await page.textContent('#seam-list li')).split(', ')[1]);
      const before = await length();
      await clickView(page, ...ON_TOP[1]);
      await clickView(page, 0.6, 0.24);
      await page.waitForFunction((before) => !document.querySelector('#seam-list li').textContent.includes(`, ${before} mm`), before);
      assert.equal(await page.locator('#seam-list li').count(), 1);
      assert.ok((await length()) > before);
      await page.click('#seam-undo');
      assert.equal(await length(), before);
    }));

  test('are drawn with the keys alone', () =>
    withTexture(async (page) => {
      await page.focus('#seam-draw');
      await page.keyboard.press('Enter');
      assert.equal(await page.evaluate(() => document.activeElement.id), 'canvas');
      await page.keyboard.press('Enter');
      assert.match(await page.textContent('#seam-hint'), /^Click where it ends/);
      for (let k = 0; k < 3; k++) await page.keyboard.press('ArrowRight');
      await page.keyboard.press('Enter');
      await page.waitForSelector('#seam-list li');
      assert.equal(await page.locator('#seam-list li').count(), 1);
    }));

  test('stay between the same places when the proxy changes', () =>
    withTexture(async (page) => {
      await page.click('#seam-draw:enabled');
      await drawSeam(page, ...ON_TOP);
      const length = async () => parseFloat((await page.textContent('#seam-list li')).split(', ')[1]);
      const before = await length();
      await page.fill('#texture-exact', '3');
      await page.press('#texture-exact', 'Enter');
      await page.waitForFunction(() => document.querySelector('#texture-facts dd').textContent.startsWith('3 mm'));
      await page.waitForSelector('#seam-stale', { state: 'hidden' });
      await idle(page);
      assert.equal(await page.locator('#seam-list li').count(), 1);
      assert.ok(Math.abs((await length()) - before) < 0.4 * before, `${await length()} mm after ${before} mm`);
    }));
});
