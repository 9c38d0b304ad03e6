/** The printer that a print is for: its profile, and what it can take. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { boxStl } from './models.mjs';
import { saved, settled, withModel } from './page.mjs';
import { served } from './site.mjs';

const site = served();

const withBox = (work) => withModel(site, boxStl([0, 0, 0], [20, 20, 4]), work);

function loadProfile(page, text) {
  return page.setInputFiles('#profile-file', { name: 'mine.json', mimeType: 'application/json', buffer: Buffer.from(text) });
}

/** Waits until the settings were held against the model, with this outcome; empty when all is well. */
function misfit(page, pattern) {
  return page.waitForFunction(
    (source) => {
      const message = document.getElementById('print-misfit');
      return source === '' ? message.hidden : !message.hidden && new RegExp(source).test(message.textContent);
    },
    pattern,
  );
}

describe('a printer', () => {
  test('whose bed is too small is told with both sizes, until it is large enough', () =>
    withBox(async (page) => {
      await loadProfile(page, '{ "name": "small one", "bedWidth": 15 }');
      await misfit(page, '^The model is 20 mm wide, the bed 15 mm\\.$');
      assert.ok(await page.isDisabled('#prepare'));
      assert.equal(await page.textContent('#printer-name'), 'small one');
      await page.click('summary:has(#printer-name)');
      assert.equal(await page.inputValue('#printer-width'), '15');
      await page.fill('#printer-width', '60');
      await page.press('#printer-width', 'Enter');
      await misfit(page, '');
      assert.ok(await page.isEnabled('#prepare'));

      const { name, bytes } = await saved(page, '#profile-save');
      const text = bytes.toString('utf8');
      assert.equal(name, 'small-one.json');
      const profile = JSON.parse(text);
      assert.deepEqual([profile.bedWidth, profile.bedDepth, profile.nozzleDiameter], [60, 220, 0.4]);
      await page.fill('#printer-width', '30');
      await page.press('#printer-width', 'Enter');
      await loadProfile(page, text);
      await page.waitForFunction(() => document.getElementById('printer-width').value === '60');
    }));

  test('with another nozzle lays lines of its width', () =>
    withBox(async (page) => {
      await loadProfile(page, '{ "nozzleDiameter": 0.6 }');
      await page.waitForFunction(() => document.getElementById('print-line-width').value === '0.6');
    }));

  test('that is none is told in words, and the last one stays', () =>
    withBox(async (page) => {
      for (const [text, reason] of [
        ['{ "bed": 180 }', /'bed'.*bedWidth/],
        ['{ "speeds": { "walls": 50 } }', /'speeds\.walls'/],
        ['{ "bedWidth": -1 }', /bedWidth cannot be -1/i],
        ['bed = 180', /JSON/],
        ['[]', /no object/],
      ]) {
        await loadProfile(page, text);
        await page.waitForSelector('#problem:not([hidden])');
        assert.equal(await page.textContent('#problem-title'), 'mine.json is no printer profile');
        assert.match(await page.textContent('#problem-detail'), reason);
        await page.click('#problem-dismiss');
      }
      assert.equal(await page.textContent('#printer-name'), 'generic Marlin printer');
    }));

  test('is asked for nothing out of range', () =>
    withBox(async (page) => {
      await page.fill('#print-density', '300');
      await page.press('#print-density', 'Enter');
      await misfit(page, '^Density cannot be 3');
      assert.ok(await page.isDisabled('#prepare'));
      await page.fill('#print-density', '');
      await page.press('#print-density', 'Enter');
      assert.equal(await page.inputValue('#print-density'), '300', 'no number is taken back');
      await page.fill('#print-density', '15');
      await page.press('#print-density', 'Enter');
      await misfit(page, '');
    }));

  test('is too coarse for a model in metres, which is asked for its unit', () =>
    withModel(
      site,
      boxStl([0, 0, 0], [0.15, 0.1, 0.1]),
      async (page) => {
        assert.match(await page.textContent('#print-tiny'), /only 0\.15 mm long/);
        await page.click('#print-unit');
        assert.equal(await page.evaluate(() => document.activeElement.id), 'unit');
        await page.selectOption('#unit', 'meter');
        await page.waitForSelector('#print-tiny', { state: 'hidden' });
        await settled(page);
        await misfit(page, '');
        assert.ok(await page.isEnabled('#prepare'));
      },
    ));
});
