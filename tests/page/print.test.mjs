/** Preparing a print on the page: settings, the preview, and what is saved. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { boxStl } from './models.mjs';
import { dropFile, fact, openPage, outside, picture, saved as savedBytes, settled, shows, slide, withModel } from './page.mjs';
import { served } from './site.mjs';

const site = served();

/** 20 layers of 0.2 mm. */
const BOX = boxStl([0, 0, 0], [20, 20, 4]);

const withBox = (work, size) => withModel(site, BOX, work, size);

async function prepare(page) {
  await page.click('#prepare:enabled');
  await page.waitForSelector('#print-facts dd');
  await page.waitForSelector('#print-dock:not([hidden])');
}

async function saved(page, selector) {
  const { name, bytes } = await savedBytes(page, selector);
  return { name, text: bytes.toString('utf8') };
}

describe('a print', () => {
  test('is estimated, drawn, and saved with all its layers', () =>
    withBox(async (page) => {
      assert.equal(await page.inputValue('#print-layer-height'), '0.2');
      assert.equal(await page.inputValue('#print-line-width'), '0.4');
      assert.equal(await page.inputValue('#print-density'), '20');
      assert.ok(await page.isDisabled('#gcode-download'));
      assert.ok(await page.isHidden('#print-dock'));
      const before = await picture(page);
      await prepare(page);
      assert.notEqual(await picture(page), before);
      assert.ok(await page.isChecked('[data-item=print]'));
      assert.ok(!(await page.isChecked('[data-item=model]')), 'the model makes room for its print');
      assert.equal(await fact(page, 'print-facts', 'Layers'), '20');
      assert.equal(await page.textContent('#print-layer-out'), 'layer 20 of 20, 4 mm');

      const slices = await saved(page, '#slices-download');
      assert.equal(slices.name, 'box-layers.3mf');
      assert.ok(slices.text.startsWith('PK') && slices.text.includes('3D/3dmodel.model'));

      const { name, text } = await saved(page, '#gcode-download');
      assert.equal(name, 'box.gcode');
      assert.equal(text.match(/^;LAYER:\d+$/gm).length, 20);
      const seconds = Number(/^;TIME:(\d+)$/m.exec(text)[1]);
      const metres = Number(/^;Filament used: ([\d.]+)m$/m.exec(text)[1]);
      assert.ok(seconds >= 60 && seconds < 3600);
      assert.equal(await fact(page, 'print-facts', 'Time'), `${Math.round(seconds / 60)} min`);
      const [length, mass] = (await fact(page, 'print-facts', 'Filament')).split(', ');
      assert.ok(Math.abs(inMetres(length) - metres) <= 0.005 * metres, `${length} for ${metres} m`);
      const grams = metres * Math.PI * (1.75 / 2) ** 2 * 1.24;
      assert.match(mass, / g$/);
      assert.ok(Math.abs(parseFloat(mass) - grams) <= 0.01 * grams, `${mass} for ${grams} g`);
    }));

  test('is prepared as it is set, and said to be of other settings when they change', () =>
    withBox(async (page) => {
      await page.fill('#print-layer-height', '0.4');
      await page.fill('#print-density', '100');
      await page.selectOption('#print-infill', 'gyroid');
      await prepare(page);
      assert.equal(await fact(page, 'print-facts', 'Layers'), '10');
      const grams = async () => parseFloat((await fact(page, 'print-facts', 'Filament')).split(', ')[1]);
      const dense = await grams();
      assert.ok(await page.isHidden('#print-stale'));
      await page.fill('#print-density', '0');
      await page.press('#print-density', 'Enter');
      assert.ok(await page.isVisible('#print-stale'));
      await page.click('#prepare:enabled');
      await page.waitForSelector('#print-stale', { state: 'hidden' });
      const hollow = await grams();
      assert.ok(hollow < dense, `${hollow} g without infill, ${dense} g full of it`);
    }));

  test('is shown up to a layer, a single layer, and only the kinds that are wanted', () =>
    withBox(async (page) => {
      await prepare(page);
      const whole = await picture(page);
      await slide(page, '#print-layer', 4);
      assert.equal(await page.textContent('#print-layer-out'), 'layer 5 of 20, 1 mm');
      const five = await picture(page);
      assert.notEqual(five, whole);
      await page.check('#print-only');
      const fifth = await picture(page);
      assert.notEqual(fifth, five);
      await page.uncheck('#print-only');
      assert.equal(await picture(page), five);
      await slide(page, '#print-move', 3);
      assert.notEqual(await picture(page), five);
      assert.match(await page.textContent('#print-move-out'), /^move 3 of \d+$/);
      await page.focus('#print-layer');
      await page.keyboard.press('ArrowRight');
      assert.match(await page.getAttribute('#print-layer', 'aria-valuetext'), /^layer 6 of 20/);
      await slide(page, '#print-layer', 19);
      assert.equal(await picture(page), whole);
      assert.ok(!(await page.isChecked('[data-move=travel]')), 'travel is not shown at first');
      await page.uncheck('[data-move=outerWall]');
      assert.notEqual(await picture(page), whole);
      await page.check('[data-move=outerWall]');
      assert.equal(await picture(page), whole);
      const { name, text } = await saved(page, '#print-layer-download');
      assert.match(name, /^box-z3\.900\.svg$/);
      assert.match(text, /<svg/);
    }));

  test('plays, pauses where it is, and ends with its last move', () =>
    withBox(async (page) => {
      await prepare(page);
      const whole = await picture(page);
      await page.selectOption('#print-pace', '1');
      await page.click('#print-play');
      await page.waitForFunction(() => document.getElementById('print-move').valueAsNumber > 0);
      await page.click('#print-play');
      assert.equal(await page.textContent('#print-play'), 'Play');
      const place = () => page.evaluate(() => ['print-layer-out', 'print-move-out'].map((id) => document.getElementById(id).textContent));
      const paused = await place();
      assert.match(paused[0], /^layer 1 of 20/);
      assert.notEqual(await picture(page), whole);
      assert.deepEqual(await place(), paused);
      await page.selectOption('#print-pace', '1000');
      await page.click('#print-play');
      await page.waitForFunction(() => document.getElementById('print-play').textContent === 'Play');
      assert.match((await place())[0], /^layer 20 of 20/);
      assert.equal(await picture(page), whole);
    }));

  test('makes way when another model is opened', () =>
    withBox(async (page) => {
      await prepare(page);
      await page.selectOption('#sample', 'teapot.obj');
      await shows(page, '992');
      assert.ok(await page.isHidden('#print-dock'));
      assert.equal(await page.locator('#print-facts dd').count(), 0);
      assert.ok(await page.isDisabled('#gcode-download'));
    }));

  test('is cancelled while it is prepared, and the page goes on', async () => {
    const page = await openPage(site.browser, site.server.url);
    try {
      await page.click('#prepare:enabled');
      await page.waitForSelector('#job:not([hidden])');
      await page.keyboard.press('Escape');
      await page.waitForSelector('#job', { state: 'hidden' });
      assert.ok(await page.isHidden('#problem'), 'cancelling is no error');
      assert.equal(await page.locator('#print-facts dd').count(), 0);
      await dropFile(page, 'box.stl', BOX);
      await shows(page, '12');
      await settled(page);
      await prepare(page);
      assert.deepEqual(page.errors, []);
    } finally {
      await page.context().close();
    }
  });

  test('fits 390 px without scrolling sideways', () =>
    withBox(
      async (page) => {
        await prepare(page);
        assert.deepEqual(await outside(page), []);
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth), 0);
        const canvas = await page.locator('#canvas').boundingBox();
        assert.ok(canvas.height > 200, `the view is ${canvas.height} px high`);
        const [dock, lowest] = await Promise.all(['#print-dock', '#print-move'].map((id) => page.locator(id).boundingBox()));
        assert.ok(lowest.y + lowest.height <= dock.y + dock.height, 'the dock holds its sliders');
      },
      { width: 390, height: 844 },
    ));
});

function inMetres(text) {
  return parseFloat(text) / (text.endsWith(' mm') ? 1000 : 1);
}
