/** Points: their normals, their measures and their surface. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { sphereXyz } from './models.mjs';
import { dropFile, fact, number, picture, settled, viewPixels, withPage as onSite } from './page.mjs';
import { served } from './site.mjs';

const site = served();

const withPage = (options, work) => onSite(site, options, work);

describe('a cloud', () => {
  test('with normals has a layer at once', () =>
    withPage({}, async (page) => {
      await page.selectOption('#sample', 'dragon-points.ply');
      await page.waitForFunction(() => document.querySelector('#facts dt').textContent === 'Points');
      await settled(page);
      assert.equal(await fact(page, 'facts', 'Normals'), 'yes');
      assert.ok((await number(page, 'layer-facts', 'Area')) > 500);
    }));

  test('without normals offers to estimate them, warns, and then has an inside', () =>
    withPage({}, async (page) => {
      await dropFile(page, 'ball.xyz', sphereXyz(4000, 10));
      await page.waitForSelector('#orient:visible');
      assert.equal(await fact(page, 'facts', 'Normals'), 'missing');
      assert.ok(await page.isDisabled('#voxelize'));
      await page.click('#orient');
      await page.waitForSelector('#orient-block', { state: 'hidden' });
      await settled(page);
      assert.ok((await page.locator('#warnings li').count()) > 0, 'estimated normals come with a warning');
      const area = await number(page, 'layer-facts', 'Area');
      assert.ok(Math.abs(area / (Math.PI * 100) - 1) < 0.03, `the middle of the ball is ${Math.PI * 100} mm², got ${area}`);
    }));

  test('shows normals while they settle, and stops when told to', () =>
    withPage({}, async (page) => {
      // So many that the job lasts longer than looking at it.
      await dropFile(page, 'ball.xyz', sphereXyz(150_000, 10));
      await page.waitForSelector('#orient:visible');
      const before = await viewPixels(page);
      await page.click('#orient');
      await page.waitForFunction(() => document.getElementById('job-progress').value > 0.05);
      assert.notDeepEqual(await viewPixels(page), before, 'the points are shaded before the job ends');
      assert.ok(await page.isVisible('#job'));
      await page.keyboard.press('Escape');
      await page.waitForSelector('#job', { state: 'hidden' });
      assert.equal(await fact(page, 'facts', 'Normals'), 'missing');
      await page.waitForTimeout(200);
      assert.deepEqual(await viewPixels(page), before, 'the points look as before');
      await page.selectOption('#orient-method', 'propagation');
      await page.click('#orient');
      await page.waitForSelector('#orient-block', { state: 'hidden' });
      await settled(page);
      assert.equal(await fact(page, 'facts', 'Normals'), 'yes');
    }));

  test('is coloured by the area of points and the noise around them, and shown beside its surface', () =>
    withPage({}, async (page) => {
      await dropFile(page, 'ball.xyz', sphereXyz(4000, 10));
      await page.waitForSelector('#orient:visible');
      assert.ok(await page.isHidden('#measure-legend'));
      const plain = await picture(page);
      await page.selectOption('#measure', 'noise');
      await page.waitForSelector('#measure-legend:not([hidden])');
      assert.match(await page.textContent('#measure-high'), / mm$/);
      assert.notEqual(await picture(page), plain);
      assert.ok(await page.isDisabled('#halves'));
      await page.click('#orient');
      await page.waitForSelector('#orient-block', { state: 'hidden' });
      await settled(page);
      await page.selectOption('#measure', 'area');
      await page.waitForFunction(() => document.getElementById('measure-high').textContent.endsWith(' mm²'));
      const [low, high] = await Promise.all(['#measure-low', '#measure-high'].map(async (id) => parseFloat(await page.textContent(id))));
      const each = (4 * Math.PI * 100) / 4000;
      assert.ok(low <= 1.05 * each && high >= 0.95 * each && high < 2 * each, `${low} to ${high} mm² for ${each}`);
      await page.selectOption('#measure', '');
      assert.ok(await page.isHidden('#measure-legend'));
      await page.click('#surface');
      await settled(page);
      const whole = await picture(page);
      await page.click('#halves');
      assert.equal(await page.getAttribute('#halves', 'aria-pressed'), 'true');
      assert.deepEqual(await page.locator('#half-names span').allTextContents(), ['Model', 'Surface']);
      assert.notEqual(await picture(page), whole);
      await page.click('#halves');
      await page.waitForTimeout(200);
      assert.equal(await picture(page), whole);
      await page.selectOption('#sample', 'teapot.obj');
      await settled(page);
      assert.ok(await page.isHidden('#measure-field'));
    }));
});
