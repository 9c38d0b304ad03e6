/** What the address of the page says, and what is there again when the page is loaded again. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { boxStl } from './models.mjs';
import { dropFile, fact, settled, shows, slide, visit, withPage } from './page.mjs';
import { served } from './site.mjs';

const site = served();

const hash = (page) => page.evaluate(() => location.hash);

async function reload(page) {
  await page.reload();
  await settled(page);
}

describe('the address', () => {
  test('follows the model and the tool, and leads back', () =>
    withPage(site, { unfolded: ['voxels-block'], hash: '#sample=teapot' }, async (page) => {
      assert.equal(await hash(page), '#sample=teapot');
      await page.click('#voxel-threshold');
      assert.equal(await hash(page), '#sample=teapot&tool=voxels');
      await page.selectOption('#sample', 'dragon-points.ply');
      await page.waitForFunction(() => location.hash.startsWith('#sample=dragon-points'));
      await page.goBack();
      await shows(page, '992');
      await settled(page);
      assert.equal(await hash(page), '#sample=teapot&tool=voxels');
      await page.goForward();
      await page.waitForFunction(() => document.querySelector('#facts dt').textContent === 'Points');
      assert.equal(await page.inputValue('#sample'), 'dragon-points.ply');
    }));

  test('leads to a sample and a tool, which is opened and in sight, also when the report above it has come', () =>
    withPage(site, { unfolded: ['check-block'], hash: '#sample=teapot&tool=texture' }, async (page) => {
      assert.equal(await fact(page, 'facts', 'Triangles'), '992');
      await page.waitForSelector('#verdict:not([hidden])');
      assert.ok(await page.locator('#texture').isVisible());
      await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => setTimeout(drawn, 100))));
      const { y, height } = await page.locator('#texture').boundingBox();
      assert.ok(y > 0 && y + height < 900, `its button is ${y} px down`);
      await page.click('#texture-block > summary');
      await page.waitForFunction(() => location.hash === '#sample=teapot');
    }));

  test('of no sample is told, and the first one is shown', () =>
    withPage(site, { hash: '#sample=unicorn' }, async (page) => {
      assert.equal(await page.textContent('#problem-title'), 'There is no sample unicorn');
      assert.equal(await hash(page), '#sample=bunny');
    }));
});

describe('a page that is loaded again', () => {
  test('has its options, its plane and its recipe', () =>
    withPage(site, { hash: '#sample=teapot' }, async (page) => {
      const box = (id) => page.isChecked(id);
      await slide(page, '#voxel-resolution', 64);
      await page.selectOption('#voxel-method', 'rays');
      await page.selectOption('#repair-method', 'remesh');
      await page.click('#texture-block details summary');
      await page.uncheck('#texture-auto');
      await page.fill('#check-thickness', '1.5');
      await page.fill('#print-density', '35');
      await page.press('#print-density', 'Enter');
      await page.fill('#hollow-thickness', '3.5');
      await page.fill('#layer-height', '0.7');
      await page.press('#layer-height', 'Enter');
      await slide(page, '#layer-slider', 40);
      await page.check('#heat');
      await page.check('#distance');
      await reload(page);
      assert.equal(await page.textContent('#voxel-resolution-out'), '64');
      assert.equal(await page.inputValue('#voxel-method'), 'rays');
      assert.ok(await page.isVisible('#repair-cells'));
      assert.ok(!(await page.isChecked('#texture-auto')));
      assert.equal(await page.inputValue('#check-thickness'), '1.5');
      assert.equal(await page.inputValue('#print-density'), '35');
      assert.equal(await page.inputValue('#hollow-thickness'), '3.5');
      assert.match(await page.textContent('#layer-out'), /^layer 41 of/);
      assert.deepEqual([await box('#heat'), await box('#distance')], [false, true]);
      // Lengths are the model's, other options are for all.
      await page.selectOption('#sample', 'dragon-points.ply');
      await page.waitForFunction(() => document.querySelector('#facts dt').textContent === 'Points');
      await settled(page);
      assert.notEqual(await page.inputValue('#layer-height'), '0.7');
      assert.equal(await page.textContent('#voxel-resolution-out'), '64');
    }));

  test('has the file that was dropped, in its unit, until it is forgotten', () =>
    withPage(site, { hash: '#sample=teapot' }, async (page) => {
      await dropFile(page, 'secret-box.stl', boxStl([0, 0, 0], [4, 3, 2]));
      await shows(page, '12');
      await page.selectOption('#unit', 'centimeter');
      await page.waitForFunction(() => document.querySelector('#facts').textContent.includes('40 × 30 × 20'));
      await page.waitForSelector('#forget');
      assert.match(await hash(page), /^#file=\w+/);
      assert.doesNotMatch(page.url(), /secret/, 'its name is not in the address');
      await reload(page);
      assert.equal(await fact(page, 'facts', 'Size'), '40 × 30 × 20 mm');
      assert.equal(await page.locator('#sample option:checked').textContent(), 'secret-box.stl');
      await page.goBack();
      await shows(page, '992');
      await page.goForward();
      await shows(page, '12');
      await page.click('#forget');
      await page.waitForSelector('#forget', { state: 'hidden' });
      const later = await visit(page.context(), page.url());
      await settled(later);
      assert.equal(await later.textContent('#problem-title'), 'The file is not kept in this browser');
      assert.equal(await fact(later, 'facts', 'Triangles'), '69,451');
    }));
});
