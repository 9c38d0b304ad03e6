/** Offsets, two models together, and ways of making voxels. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { SIDES, boxStl } from './models.mjs';
import { dropFile, fact, number, picture, saved, settled, slide, withModel as onPage } from './page.mjs';
import { served } from './site.mjs';

const site = served();

const BOX = boxStl([0, 0, 0], [40, 30, 20]);

const withModel = (bytes, work) => onPage(site, bytes, work);

/** Presses a button, and waits for the end of its job. */
async function make(page, button, result) {
  await page.evaluate((result) => (document.getElementById(result).hidden = true), result);
  await page.click(`${button}:enabled`);
  await page.waitForSelector(`#${result}:not([hidden])`);
  await page.waitForSelector('#job', { state: 'hidden' });
}

async function sizeOf(page) {
  return (await fact(page, 'offset-facts', 'Size')).replace(' mm', '').split(' × ').map(Number);
}

/** Cubic millimetres, whatever unit they are told in. */
async function volume(page, list) {
  const text = await fact(page, list, 'Volume');
  return parseFloat(text.replaceAll(',', '')) * (text.endsWith(' cm³') ? 1000 : 1);
}

function near(found, expected, tolerance) {
  assert.ok(Math.abs(found - expected) <= tolerance, `${found} for ${expected}`);
}

describe('an offset', () => {
  test('is larger outside and smaller inside by what the slider says', () =>
    withModel(BOX, async (page) => {
      await page.check('#offset-sharp');
      await page.fill('#offset-exact', '2');
      await page.press('#offset-exact', 'Enter');
      await make(page, '#offset', 'offset-result');
      (await sizeOf(page)).forEach((side, k) => near(side, [44, 34, 24][k], 0.5));
      assert.ok(await page.isChecked('[data-item=offset]'));
      assert.ok(!(await page.isChecked('[data-item=model]')));
      const { name, bytes } = await saved(page, '#offset-download');
      assert.equal(name, 'box-offset.stl');
      assert.equal(bytes.length, 84 + 50 * bytes.readUInt32LE(80));

      await slide(page, '#offset-distance', -50);
      const distance = Number(await page.inputValue('#offset-exact'));
      near(distance, -0.05 * Math.hypot(40, 30, 20), 0.01);
      await make(page, '#offset', 'offset-result');
      (await sizeOf(page)).forEach((side, k) => near(side, [40, 30, 20][k] + 2 * distance, 0.5));
    }));

  test('that leaves nothing is told in words', () =>
    withModel(BOX, async (page) => {
      await page.fill('#offset-exact', '-12');
      await page.press('#offset-exact', 'Enter');
      await page.click('#offset:enabled');
      await page.waitForSelector('#problem:not([hidden])');
      assert.equal(await page.textContent('#problem-title'), 'The offset could not be made');
      assert.match(await page.textContent('#problem-detail'), /^[A-Z].*\.$/);
    }));

  test('inward leaves walls, with a hole below when one is asked for', () =>
    withModel(BOX, async (page) => {
      await page.check('#offset-sharp');
      await page.fill('#hollow-thickness', '2');
      await make(page, '#hollow', 'offset-result');
      const walls = 40 * 30 * 20 - 36 * 26 * 16;
      const closed = await volume(page, 'offset-facts');
      near(closed, walls, 0.03 * walls);
      await page.fill('#hollow-drain', '4');
      await make(page, '#hollow', 'offset-result');
      const drained = await volume(page, 'offset-facts');
      near(closed - drained, Math.PI * 2 ** 2 * 2, 8);
    }));
});

describe('a second model', () => {
  const MODEL = boxStl([0, 0, 0], [20, 20, 20]);
  const SECOND = boxStl([10, 5, 5], [30, 15, 15]);

  async function withSecond(work) {
    await withModel(MODEL, async (page) => {
      await dropFile(page, 'bar.stl', SECOND, '#second-drop');
      await page.waitForSelector('#second:not([hidden])');
      await page.waitForSelector('#job', { state: 'hidden' });
      await work(page);
    });
  }

  test('is dropped on its own field, and combined in three ways', () =>
    withSecond(async (page) => {
      assert.equal(await page.textContent('#second-name'), 'bar.stl, 12 triangles');
      assert.equal(await page.locator('#sample option:checked').textContent(), 'box.stl', 'the model stays');
      assert.equal(await page.inputValue('#second-centre-x'), '20');
      for (const [operation, expected] of [['union', 9000], ['difference', 7000], ['intersection', 1000]]) {
        await page.selectOption('#operation', operation);
        await make(page, '#combine', 'combine-result');
        near(await volume(page, 'combine-facts'), expected, 0.01);
        assert.ok((await number(page, 'combine-facts', 'Of the second')) > 0);
      }
      const { name, bytes } = await saved(page, '#combine-download');
      assert.equal(name, 'box-combined.stl');
      assert.equal(bytes.readUInt32LE(80), await number(page, 'combine-facts', 'Triangles'));
      await page.click('#combine-use:enabled');
      await page.waitForFunction(() => document.querySelector('#sample option:checked').textContent === 'box-combined');
      await settled(page);
      assert.equal(await fact(page, 'facts', 'Size'), '10 × 10 × 10 mm');
    }));

  test('is placed by numbers', () =>
    withSecond(async (page) => {
      const before = await picture(page);
      const set = async (id, value) => {
        await page.fill(id, value);
        await page.press(id, 'Enter');
      };
      await set('#second-centre-x', '45');
      assert.notEqual(await picture(page), before);
      await make(page, '#combine', 'combine-result');
      near(await volume(page, 'combine-facts'), 10_000, 0.01);
      // Half as large, upright in the middle of the model's top: 5 of its 10 mm are inside.
      await set('#second-centre-x', '10');
      await set('#second-centre-z', '20');
      await set('#second-angles-y', '90');
      await set('#second-scale', '0.5');
      await make(page, '#combine', 'combine-result');
      near(await volume(page, 'combine-facts'), 8000 + 5 * 5 * 5, 0.01);
      await page.click('#second-back');
      assert.deepEqual(await Promise.all(['#second-centre-x', '#second-angles-y', '#second-scale'].map((id) => page.inputValue(id))), ['20', '0', '1']);
    }));

  test('beside the model has nothing in common with it, which is told', () =>
    withSecond(async (page) => {
      await page.fill('#second-centre-x', '100');
      await page.press('#second-centre-x', 'Enter');
      await page.selectOption('#operation', 'intersection');
      await page.click('#combine:enabled');
      await page.waitForSelector('#problem:not([hidden])');
      assert.equal(await page.textContent('#problem-title'), 'Nothing is left of the models');
      assert.match(await page.textContent('#problem-detail'), /^[A-Z].*\.$/);
      assert.ok(await page.isHidden('#combine-result'));
    }));

  test('is a simple shape that handles move, while the camera stays', () =>
    withModel(MODEL, async (page) => {
      await page.selectOption('#second-shape', 'sphere');
      await page.waitForSelector('#second:not([hidden])');
      await page.waitForSelector('#job', { state: 'hidden' });
      const where = () => Promise.all(['x', 'y', 'z'].map((axis) => page.inputValue(`#second-centre-${axis}`)));
      assert.deepEqual(await where(), ['10', '10', '10']);
      const axes = await page.innerHTML('#axes');
      const { x, y, width, height } = await page.locator('#canvas').boundingBox();
      const middle = [x + width / 2, y + height / 2];
      await page.mouse.move(...middle);
      await page.mouse.down();
      await page.mouse.move(middle[0] + 30, middle[1], { steps: 5 });
      await page.mouse.move(middle[0] + 80, middle[1], { steps: 5 });
      await page.mouse.up();
      assert.notDeepEqual(await where(), ['10', '10', '10']);
      assert.equal(await page.innerHTML('#axes'), axes);
      await page.click('#second-remove');
      assert.ok(await page.isHidden('#second'));
    }));
});

describe('ways of making voxels', () => {
  test('are held against the exact one, and their mistakes coloured', () =>
    withModel(boxStl([0, 0, 0], [40, 30, 20], { without: SIDES.left }), async (page) => {
      await slide(page, '#voxel-resolution', 32);
      const before = await picture(page);
      await make(page, '#voxel-compare', 'comparison');
      const rows = await page.locator('#comparison-rows tr').evaluateAll((rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent)));
      assert.deepEqual(rows.map(([method]) => method), ['Exact', 'Rays', 'Fast', 'Points']);
      assert.ok(rows.every(([, time]) => / m?s$/.test(time)));
      const wrong = rows.slice(1).map(([, , text]) => parseInt(text.replaceAll(',', ''), 10));
      assert.ok(wrong[0] > 1000, 'rays through the opening miss the wall there');
      assert.ok(wrong[1] < 0.02 * 32 * 24 * 16, `${wrong[1]} are wrong by the approximation`);
      const rays = await picture(page);
      assert.notEqual(rays, before);
      await page.check('#comparison-rows [value=fast]');
      assert.notEqual(await picture(page), rays);
      assert.equal(await page.evaluate(() => document.activeElement.value), 'fast');
    }));

  test('give files of voxels and of their surface', () =>
    withModel(BOX, async (page) => {
      await slide(page, '#voxel-resolution', 32);
      await page.selectOption('#voxel-method', 'rays');
      await page.click('#voxelize:enabled');
      await page.waitForSelector('#voxel-download:enabled');
      assert.equal(await volume(page, 'voxel-facts'), 24_000);
      for (const [format, start] of [['vox', 'VOX '], ['nrrd', 'NRRD'], ['ply', 'ply\n']]) {
        await page.selectOption('#voxel-download-format', format);
        const { name, bytes } = await saved(page, '#voxel-download');
        assert.equal(name, `box-voxels.${format}`);
        assert.equal(bytes.subarray(0, 4).toString('latin1'), start);
      }
    }));
});

describe('a field', () => {
  test('is saved, and opened again with its model', () =>
    withModel(boxStl([0, 0, 0], [40, 30, 20], { without: SIDES.top }), async (page) => {
      const area = await number(page, 'layer-facts', 'Area');
      const { name, bytes } = await saved(page, '#field-save');
      assert.equal(name, 'box.field');
      await dropFile(page, name, bytes);
      await page.waitForFunction(() => document.querySelector('#sample option:checked').textContent === 'box.field');
      await settled(page);
      assert.equal(await fact(page, 'facts', 'Triangles'), '10');
      assert.equal(await number(page, 'layer-facts', 'Area'), area);
      assert.ok(await page.isHidden('#unit-field'), 'its numbers are millimetres');
    }));
});
