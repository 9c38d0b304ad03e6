/** Everything that was made of a model, in one list. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { boxStl } from './models.mjs';
import { dropFile, fact, make, picture, saved, shows, slide, withModel } from './page.mjs';
import { served } from './site.mjs';

const site = served();

const BOX = boxStl([0, 0, 0], [40, 30, 20], { without: [2, 3] });

const names = (page) => page.locator('#results label').evaluateAll((labels) => labels.map((label) => label.querySelector('.name').textContent));
const chosen = (page) => page.locator('#results li:has(input:checked) label').evaluateAll((labels) => labels.map((label) => label.querySelector('.name').textContent));
const choose = (page, name) => page.locator('#results label', { hasText: name }).locator('input').check();

async function surface(page, resolution) {
  await slide(page, '#surface-resolution', resolution);
  await make(page, '#surface');
}

describe('results', () => {
  test('are listed, shown one or the other, held against each other, saved and removed', () =>
    withModel(site, BOX, async (page) => {
      assert.ok(await page.isHidden('#results-block'));
      await surface(page, 16);
      const coarse = await fact(page, 'surface-facts', 'Triangles');
      const before = await picture(page);
      await surface(page, 64);
      const fine = await fact(page, 'surface-facts', 'Triangles');
      await make(page, '#repair');
      assert.deepEqual(await names(page), ['The model', 'Surface 1', 'Surface 2', 'Repaired']);
      await page.click('#halves');

      await choose(page, 'Surface 1');
      assert.equal(await fact(page, 'surface-facts', 'Triangles'), coarse, 'the panel tells of what is shown');
      assert.equal(await picture(page), before);
      assert.deepEqual(await chosen(page), ['Surface 1']);
      await choose(page, 'The model');
      assert.ok(await page.isChecked('[data-item=model]'));
      assert.ok(!(await page.isChecked('[data-item=surface]')));
      await page.check('[data-item=surface]');
      assert.deepEqual(await chosen(page), [], 'two things at once are not one result');

      await choose(page, 'Surface 1');
      await page.selectOption('#against', { label: 'Surface 2' });
      assert.equal(await page.getAttribute('#halves', 'aria-pressed'), 'true');
      assert.deepEqual(await page.locator('#half-names span').allTextContents(), ['Surface 2', 'Surface 1']);
      const beside = await picture(page);
      await page.selectOption('#against', { label: 'the model' });
      assert.deepEqual(await page.locator('#half-names span').allTextContents(), ['Model', 'Surface 1']);
      assert.notEqual(await picture(page), beside);
      await page.selectOption('#against', { label: 'Surface 2' });

      const { name, bytes } = await saved(page, '[aria-label="Save Surface 2"]');
      assert.equal(name, 'box-surface.stl');
      assert.equal(bytes.readUInt32LE(80).toLocaleString('en'), fine, 'it is the one that is named');

      await page.click('[aria-label="Remove Surface 2"]');
      assert.deepEqual(await page.locator('#half-names span').allTextContents(), ['Model', 'Surface']);
      await page.click('[aria-label="Remove Surface"]');
      assert.deepEqual(await names(page), ['The model', 'Repaired']);
      assert.ok(await page.isChecked('[data-item=model]'), 'the model takes the place of what is gone');
      assert.equal(await page.locator('#surface-facts dd').count(), 0);
      await page.click('[aria-label="Remove Repaired"]');
      assert.ok(await page.isHidden('#results-block'));
    }));

  test('are as many as there is room for, and go with their model', () =>
    withModel(site, BOX, async (page) => {
      for (let k = 0; k < 9; k++) await surface(page, 16);
      assert.equal((await names(page)).length, 9);
      await dropFile(page, 'other.stl', boxStl([0, 0, 0], [1, 1, 1]));
      await shows(page, '12');
      assert.ok(await page.isHidden('#results-block'));
    }));
});
