/** What is wrong with a model, seen on the page, and models put right. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { SIDES, boxStl, sphereXyz } from './models.mjs';
import { dropFile, fact, number, openPage, outside, picture, saved, settled, withModel } from './page.mjs';
import { served } from './site.mjs';

const site = served();

const [LOW, HIGH] = [[0, 0, 0], [40, 30, 20]];

/** A page that shows a box with its report, which small models get by themselves. */
function withBox(faults, work, size) {
  const shown = async (page) => {
    await page.waitForSelector('#verdict:not([hidden])');
    await work(page);
  };
  return withModel(site, boxStl(LOW, HIGH, faults), shown, size);
}

function figureOf(page, defect) {
  return page.textContent(`[data-defect=${defect}] .figure`);
}

function rating(page) {
  return page.getAttribute('#verdict', 'data-rating');
}

/** The figures before and after a repair. */
async function figures(page, label) {
  return page.evaluate((label) => {
    const row = [...document.querySelectorAll('#repair-rows tr')].find((row) => row.firstChild.textContent === label);
    return row && [...row.querySelectorAll('td')].map((cell) => cell.textContent);
  }, label);
}

async function repair(page) {
  await page.click('#repair:enabled');
  await page.waitForSelector('#repair-result:not([hidden])');
  await page.waitForSelector('#job', { state: 'hidden' });
}

describe('the check', () => {
  test('of a closed box finds nothing wrong', () =>
    withBox({}, async (page) => {
      assert.equal(await rating(page), 'good');
      assert.match(await page.textContent('#verdict-text'), /^[A-Z].*\.$/);
      assert.match(await page.textContent('#check-absent'), /^Not found: holes, flipped faces, .*\.$/);
      assert.equal(await fact(page, 'check-facts', 'Triangles'), '12, 8 vertices');
      assert.equal(await fact(page, 'check-facts', 'Shells'), '1, closed');
      assert.equal(await fact(page, 'check-facts', 'Volume'), '24 cm³');
      assert.equal(await fact(page, 'check-facts', 'Area'), '5,200 mm²');
      assert.ok(await page.isHidden('#turn'), 'there is nothing to turn');
    }));

  test('lists a hole, colours it, looks at it, and is saved', () =>
    withBox({ without: SIDES.top }, async (page) => {
      assert.equal(await figureOf(page, 'holes'), '1 hole, 4 edges');
      assert.ok((await page.locator('#verdict-reasons li').count()) > 0, 'the verdict has reasons');
      const whole = await picture(page);
      await page.click('[data-defect=holes]');
      assert.equal(await page.getAttribute('[data-defect=holes]', 'aria-pressed'), 'true');
      assert.equal(await page.textContent('#defect-place'), 'in one place');
      const shown = await picture(page);
      assert.notEqual(shown, whole);
      await page.click('#defect-next');
      assert.equal(await page.textContent('#defect-place'), '1 of 1');
      assert.notEqual(await picture(page), shown, 'seen from above, in another colour');
      await page.click('[data-defect=holes]');
      assert.equal(await page.getAttribute('[data-defect=holes]', 'aria-pressed'), 'false');
      assert.ok(await page.isHidden('#stepper'));

      const { name, bytes } = await saved(page, '#check-save');
      assert.equal(name, 'box-check.json');
      const { boundary, verdict, triangles } = JSON.parse(bytes.toString('utf8'));
      assert.deepEqual([boundary.loops.count, boundary.loops.list[0].vertices.length, triangles], [1, 4, 10]);
      assert.ok(verdict.text.length > 0);
    }));

  test('steps through places, around and back', () =>
    withBox({ without: [...SIDES.left, ...SIDES.right] }, async (page) => {
      assert.equal(await figureOf(page, 'holes'), '2 holes, 8 edges');
      await page.click('[data-defect=holes]');
      const seen = [];
      for (const button of ['#defect-next', '#defect-next', '#defect-next', '#defect-previous']) {
        await page.click(button);
        seen.push(await page.textContent('#defect-place'));
      }
      assert.deepEqual(seen, ['1 of 2', '2 of 2', '1 of 2', '2 of 2']);
      await page.click('#defect-hide');
      assert.equal(await page.evaluate(() => document.activeElement.dataset.defect), 'holes');
    }));

  test('colours flipped faces, and turns them when it is told to', () =>
    withBox({ flipped: SIDES.front }, async (page) => {
      assert.equal(await figureOf(page, 'flipped'), '2 faces');
      const before = await picture(page);
      await page.click('[data-defect=flipped]');
      assert.notEqual(await picture(page), before);
      await page.click('#turn');
      await page.waitForFunction(() => document.getElementById('verdict').dataset.rating === 'good');
      await settled(page);
      assert.equal(await page.locator('[data-defect=flipped]').count(), 0);
      assert.ok(await page.isHidden('#turn'));
      assert.equal(await fact(page, 'check-facts', 'Volume'), '24 cm³');
      assert.ok(Math.abs((await number(page, 'layer-facts', 'Area')) - 1200) < 1);
    }));

  test('goes by the least thickness that is asked for', () =>
    withBox({}, async (page) => {
      assert.equal(await page.locator('[data-defect=thin]').count(), 0);
      await page.fill('#check-thickness', '25');
      await page.press('#check-thickness', 'Enter');
      await page.waitForSelector('[data-defect=thin]');
      assert.match(await figureOf(page, 'thin'), /^\d+ faces, from 20 mm$/);
      await page.fill('#check-thickness', '-1');
      await page.press('#check-thickness', 'Enter');
      assert.equal(await page.inputValue('#check-thickness'), '25', 'a thickness that makes no sense is taken back');
    }));

  test('is of models with faces alone', async () => {
    const page = await openPage(site.browser, site.server.url, { hash: '#sample=teapot' });
    try {
      await dropFile(page, 'ball.xyz', sphereXyz(2000, 10));
      await page.waitForSelector('#orient:visible');
      assert.ok(await page.isDisabled('#check'));
      assert.ok(await page.isVisible('#check-cloud'));
      assert.equal(await page.inputValue('#repair-method'), 'remesh');
      assert.ok(await page.isDisabled('#repair'), 'points without normals have no inside');
    } finally {
      await page.context().close();
    }
  });
});

describe('a repair', () => {
  test('closes a box, shows it beside the open one, and is saved in every format', () =>
    withBox({ without: SIDES.top, flipped: [0] }, async (page) => {
      await repair(page);
      assert.deepEqual(await figures(page, 'Holes'), ['1', '0']);
      assert.equal((await figures(page, 'Open edges'))[1], '0');
      assert.equal((await figures(page, 'Flipped faces'))?.[1] ?? '0', '0');
      assert.equal(await page.getAttribute('#halves', 'aria-pressed'), 'true');
      assert.deepEqual(await page.locator('#half-names span').allTextContents(), ['Model', 'Repaired']);
      const triangles = parseInt((await figures(page, 'Triangles'))[1].replaceAll(',', ''), 10);
      assert.ok(triangles >= 12);

      for (const [format, holds] of [
        ['stl', (bytes) => bytes.readUInt32LE(80) === triangles && bytes.length === 84 + 50 * triangles],
        ['obj', (bytes) => bytes.toString('latin1').match(/^f /gm).length === triangles],
        ['ply', (bytes) => bytes.toString('latin1').includes(`element face ${triangles}`)],
        ['3mf', (bytes) => bytes.toString('latin1').startsWith('PK') && bytes.includes('3D/3dmodel.model')],
      ]) {
        await page.selectOption('#repair-download-format', format);
        const { name, bytes } = await saved(page, '#repair-download');
        assert.equal(name, `box-repaired.${format}`);
        assert.ok(holds(bytes), format);
      }
      assert.equal(await page.inputValue('#surface-download-format'), '3mf', 'the format is one for all');

      await page.click('#repair-use:enabled');
      await page.waitForFunction(() => document.querySelector('#sample option:checked').textContent === 'box-repaired');
      await settled(page);
      assert.equal(await fact(page, 'facts', 'Boundary edges'), 'none, it is closed');
      await page.waitForSelector('#verdict:not([hidden])');
      assert.equal(await rating(page), 'good');
    }));

  test('makes the surface anew', () =>
    withBox({ without: SIDES.top }, async (page) => {
      await page.selectOption('#repair-method', 'remesh');
      await page.uncheck('#repair-auto');
      await page.locator('#repair-resolution').fill('32');
      await repair(page);
      assert.deepEqual(await figures(page, 'Holes'), ['1', '0']);
      assert.equal((await figures(page, 'Open edges'))[1], '0');
      const cubicCentimetres = parseFloat((await figures(page, 'Volume'))[1]);
      assert.ok(cubicCentimetres > 15 && cubicCentimetres < 25, `${cubicCentimetres} cm³, w = ½ bulges or dents in the opening`);
    }));

  test('fits 390 px, its figures with it', () =>
    withBox(
      { without: SIDES.top },
      async (page) => {
        await page.click('[data-defect=holes]');
        await repair(page);
        await page.selectOption('#second-shape', 'cube');
        await page.waitForSelector('#second:not([hidden])');
        assert.deepEqual(await outside(page), []);
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth), 0);
      },
      { width: 390, height: 844 },
    ));
});
