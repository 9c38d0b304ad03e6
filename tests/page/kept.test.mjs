/** What was made of a model, when the page is loaded again. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { belongings, keeps, reload } from './kept.mjs';
import { boxStl, sphereXyz } from './models.mjs';
import { dropFile, fact, make, number, openPage, saved, settled, shows, slide, visit, withModel, withPage } from './page.mjs';
import { served } from './site.mjs';

const site = served();

const TEAPOT = '#sample=teapot';
const OPEN_BOX = boxStl([0, 0, 0], [40, 30, 20], { without: [2, 3] });

const rows = (page) => page.locator('#results label').allTextContents();
const chosen = (page) => page.locator('#results li:has(input:checked) .name').allTextContents();

async function surface(page, resolution = 16) {
  await slide(page, '#surface-resolution', resolution);
  await make(page, '#surface');
}

describe('results', () => {
  test('are there again as they were: their order, figures, bytes, and which is shown; not of another model', () =>
    withPage(site, { hash: TEAPOT }, async (page) => {
      await slide(page, '#offset-resolution', 16);
      await slide(page, '#voxel-resolution', 16);
      await make(page, '#repair');
      await make(page, '#offset');
      await surface(page);
      await surface(page, 24);
      await make(page, '#voxelize');
      await page.fill('#print-layer-height', '2');
      await page.press('#print-layer-height', 'Enter');
      await make(page, '#prepare');
      await page.locator('#results label', { hasText: 'Surface 1' }).locator('input').check();
      await page.selectOption('#against', { label: 'Repaired' });
      const state = async () => ({ rows: await rows(page), chosen: await chosen(page), halves: await page.locator('#half-names span').allTextContents() });
      const files = async () => [await saved(page, '[aria-label="Save Repaired"]'), await saved(page, '[aria-label="Save Surface 1"]'), await saved(page, '#gcode-download')];
      const [before, filesBefore, facts] = [await state(), await files(), await page.textContent('#repair-result')];
      await keeps(page, 'result', 'result', 'result', 'result', 'result', 'result', 'view');
      await reload(page, 6);
      assert.deepEqual(await state(), before);
      assert.deepEqual(await files(), filesBefore);
      assert.equal(await page.textContent('#repair-result'), facts);
      assert.ok(await page.isHidden('#print-stale'));
      assert.equal(await page.textContent('#note'), 'teapot.obj: 992 triangles', 'they are not news');

      await page.selectOption('#sample', 'dragon-points.ply');
      await page.waitForFunction(() => document.querySelector('#facts dt').textContent === 'Points');
      await settled(page);
      assert.ok(await page.isHidden('#results-block'));
      await page.goBack();
      await page.waitForSelector('[aria-label="Save Repaired"]');
      assert.deepEqual(await state(), before);
    }));

  test('that are removed stay so', () =>
    withPage(site, { hash: TEAPOT }, async (page) => {
      await surface(page);
      await surface(page, 24);
      const [, , second] = await rows(page);
      await keeps(page, 'result', 'result', 'view');
      await page.click('[aria-label="Remove Surface 1"]');
      await keeps(page, 'result', 'view');
      await reload(page, 1);
      assert.equal((await rows(page))[1].replace('Surface', 'Surface 2'), second);
      await page.click('[aria-label="Remove Surface"]');
      await keeps(page);
      await reload(page, 0);
      assert.ok(await page.isChecked('[data-item=model]'));
    }));

  test('of two pages of one model are all there', () =>
    withPage(site, { hash: TEAPOT }, async (page) => {
      const other = await visit(page.context(), page.url());
      await settled(other);
      await surface(page);
      await keeps(page, 'result', 'view');
      await make(other, '#repair');
      await keeps(page, 'result', 'result', 'view');
      await other.close();
      await reload(page, 2);
      assert.deepEqual((await rows(page)).map((row) => row.match(/^[A-Z][a-z]+/)[0]), ['The', 'Surface', 'Repaired']);
      await page.click('#forget:visible');
      await page.waitForFunction(() => document.getElementById('kept-text').textContent.endsWith(' loaded again: Surface, Repaired.'));
      await keeps(page);
      await surface(page, 24);
      await keeps(page, 'result', 'view');
    }));

  test('of an engine that dies are read again by the next one', () =>
    withPage(site, { hash: TEAPOT }, async (page) => {
      await make(page, '#repair');
      await surface(page);
      await keeps(page, 'result', 'result', 'view');
      const before = [...(await rows(page))].sort();
      const engine = page.workers().find((worker) => /worker-|worker\.js/.test(worker.url()) && !worker.url().includes('pool'));
      await engine.evaluate(() => void setTimeout(() => { throw new Error('broken on purpose'); }));
      await slide(page, '#layer-slider', 100);
      await page.waitForSelector('#problem:not([hidden])');
      await page.waitForSelector('[aria-label="Save Repaired"]');
      assert.deepEqual([...(await rows(page))].sort(), before);
      assert.ok((await saved(page, '[aria-label="Save Repaired"]')).bytes.length > 84);
    }));

  test('of a file are forgotten with it', () =>
    withModel(site, OPEN_BOX, async (page) => {
      await surface(page);
      await page.waitForSelector('#forget:visible');
      await keeps(page, 'result', 'view');
      assert.match(await page.textContent('#kept-text'), /^It is kept with .* again\.$/);
      await reload(page, 1);
      await page.click('#forget:visible');
      await page.waitForSelector('#forget', { state: 'hidden' });
      assert.deepEqual(await belongings(page), []);
      await make(page, '#repair');
      await page.waitForTimeout(300);
      assert.deepEqual(await belongings(page), [], 'nothing is kept of what is forgotten');
    }));
});

test('a second model is there again where it was, and gives the same', () =>
  withModel(site, boxStl([0, 0, 0], [20, 20, 20]), async (page) => {
    await dropFile(page, 'bar.stl', boxStl([10, 5, 5], [30, 15, 15]), '#second-drop');
    await page.waitForSelector('#combine:enabled');
    for (const [id, value] of [['centre-x', '12.5'], ['angles-z', '30'], ['scale', '0.75']]) {
      await page.fill(`#second-${id}`, value);
      await page.press(`#second-${id}`, 'Enter');
    }
    const combined = async () => {
      await make(page, '#combine');
      return saved(page, '#combine-download');
    };
    const before = await combined();
    await page.uncheck('[data-item=layer]');
    await keeps(page, 'result', 'second', 'view');
    await reload(page, 1);
    assert.equal(await page.textContent('#second-name'), 'bar.stl, 12 triangles');
    assert.deepEqual(await Promise.all(['centre-x', 'angles-z', 'scale'].map((id) => page.inputValue(`#second-${id}`))), ['12.5', '30', '0.75']);
    assert.deepEqual(await saved(page, '#combine-download'), before);
    assert.ok(!(await page.isChecked('[data-item=layer]')));
    assert.deepEqual(await combined(), before);
    await page.click('#second-remove');
    await keeps(page, 'result', 'result', 'view');
    await reload(page, 2);
    assert.ok(await page.isHidden('#second'));
  }));

test('a cloud has the normals again that were estimated for it, and what was made of it', () =>
  withPage(site, { hash: TEAPOT }, async (page) => {
    await dropFile(page, 'ball.xyz', sphereXyz(1000, 10));
    await page.click('#orient:visible');
    await page.waitForSelector('#orient-block', { state: 'hidden' });
    await settled(page);
    await surface(page);
    await keeps(page, 'normals', 'result', 'view');
    const state = async () => [await fact(page, 'facts', 'Format'), await fact(page, 'facts', 'Normals'), await page.textContent('#warnings'), await number(page, 'layer-facts', 'Area'), await rows(page)];
    const before = await state();
    assert.equal(before[0], 'XYZ');
    await reload(page, 1);
    assert.deepEqual(await state(), before);
    await page.selectOption('#unit', 'centimeter');
    // In another unit it is another cloud.
    await page.waitForSelector('#orient:visible');
    assert.ok(await page.isHidden('#results-block'));
  }));

describe('what cannot be read', () => {
  async function withTwo(edit, work) {
    await withPage(site, { hash: TEAPOT }, async (page) => {
      await make(page, '#repair');
      await surface(page);
      await keeps(page, 'result', 'result', 'view');
      await belongings(page, edit);
      await work(page);
    });
  }

  test('is told, and the rest is there with its model', () =>
    withTwo("const { id } = all.find(({ title }) => title === 'Repaired'); contents.put({ ...(await answer(contents.get(id))), value: { ply: new Uint8Array(9), report: {}, after: {} } }, id);", async (page) => {
      await reload(page, 1);
      assert.equal(await page.textContent('#problem-title'), 'Not all that was kept is there again');
      assert.equal(await page.textContent('#problem-detail'), 'Not readable any more: Repaired.');
      assert.match((await rows(page))[1], /^Surface/);
      await reload(page, 1);
      assert.ok(await page.isHidden('#problem'), 'it is told once');
    }));

  test('as it is of another version of the page is left out', () =>
    withTwo('for (const thing of all) things.put({ ...thing, version: 0 });', async (page) => {
      await reload(page, 0);
      assert.ok(await page.isHidden('#problem'));
      await keeps(page);
    }));
});

test('without a database the page works, and says what it does not keep', async () => {
  const page = await openPage(site.browser, site.server.url, { hash: TEAPOT });
  await page.addInitScript(() => Object.defineProperty(globalThis, 'indexedDB', { get: () => undefined }));
  await reload(page, 0);
  await surface(page);
  await page.waitForFunction(() => document.getElementById('kept-text').textContent === 'Not kept, to be made again when the page is loaded again: Surface.');
  await dropFile(page, 'box.stl', OPEN_BOX);
  await shows(page, '10');
  await page.waitForFunction(() => document.getElementById('kept-text').textContent.startsWith('Not kept: it is to be opened again'));
  await make(page, '#repair');
  assert.deepEqual(page.errors, []);
  await page.context().close();
});
