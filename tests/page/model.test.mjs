/** Models: samples, files that are dropped, and none. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { boxObj, boxStl, sphereStl } from './models.mjs';
import { contourAt, drawnPixels, dropFile, fact, make, number, sampleHeight, settled, sharedPage, shows, slide, withPage as onSite } from './page.mjs';
import { served } from './site.mjs';

const site = served();

/** A box of 40 × 30 × 20 mm: its layers have an area of 1,200 mm² and a perimeter of 140 mm. */
const BOX = boxStl([0, 0, 0], [40, 30, 20]);

const withPage = (options, work) => onSite(site, options, work);

describe('the sample', () => {
  const onPage = sharedPage(site);

  test('is shown at once with its counts, its size and its open edges', () =>
    onPage(async (page) => {
      assert.equal(await fact(page, 'facts', 'Triangles'), '69,451');
      assert.equal(await fact(page, 'facts', 'Boundary edges'), '223');
      assert.equal(await fact(page, 'facts', 'Size'), '155.7 × 120.7 × 154.3 mm');
      assert.match(await fact(page, 'facts', 'Field built'), / m?s, /);
      assert.ok((await drawnPixels(page)) > 0.1, 'the model covers a part of the view');
    }));

  test('runs on threads and says how many', () =>
    onPage(async (page) => {
      const threads = await number(page, 'engine-facts', 'Threads');
      const processors = await page.evaluate(() => navigator.hardwareConcurrency);
      assert.ok(threads >= Math.min(2, processors) && threads <= processors, `${threads} threads on ${processors} processors`);
      assert.match(await page.textContent('#engine-text'), new RegExp(`^${threads} threads?, SIMD$`));
      assert.equal(await page.getAttribute('#engine', 'data-state'), threads > 1 ? 'threads' : 'single');
    }));

  test('of the menu replaces the one before', () =>
    onPage(async (page) => {
      await page.selectOption('#sample', 'teapot.obj');
      await shows(page, '992');
      assert.equal(await fact(page, 'facts', 'Format'), 'OBJ');
    }));
});

describe('a dropped file', () => {
  const onPage = sharedPage(site, { hash: '#sample=teapot' });

  test('is measured, cut and drawn', () =>
    onPage(async (page) => {
      await dropFile(page, 'box.stl', BOX);
      await shows(page, '12');
      await settled(page);
      assert.equal(await fact(page, 'facts', 'Size'), '40 × 30 × 20 mm');
      assert.equal(await fact(page, 'facts', 'Boundary edges'), 'none, it is closed');
      assert.equal(await fact(page, 'layer-facts', 'Contours'), '1 outer');
      assert.ok(Math.abs((await number(page, 'layer-facts', 'Area')) - 1200) < 1);
      // A square of the slicer's grid, 1/256 of 40 mm, may cut each of the four corners: (2 − √2) of its side each.
      assert.ok(Math.abs((await number(page, 'layer-facts', 'Perimeter')) - 140) < (4 * (2 - Math.SQRT2) * 40) / 256);
      assert.equal(await page.locator('#sample option:checked').textContent(), 'box.stl');
    }));

  test('far from the origin is cut and drawn as well as one near it', () =>
    onPage(async (page) => {
      await dropFile(page, 'survey.obj', boxObj([500_000, 4_000_000, 100], [500_040, 4_000_030, 120]));
      await shows(page, '12');
      await settled(page);
      assert.equal(await fact(page, 'facts', 'Size'), '40 × 30 × 20 mm');
      assert.ok(Math.abs((await number(page, 'layer-facts', 'Area')) - 1200) < 1);
      assert.ok((await drawnPixels(page)) > 0.1);
    }));

  test('in metres is made larger, and what is too large for a printer is warned of', () =>
    onPage(async (page) => {
      await dropFile(page, 'box.stl', BOX);
      await shows(page, '12');
      await settled(page);
      assert.equal(await page.locator('#warnings li').count(), 0);
      await page.selectOption('#unit', 'meter');
      await page.waitForSelector('#warnings li');
      assert.equal(await fact(page, 'facts', 'Size'), '40,000 × 30,000 × 20,000 mm');
    }));

  test('that is broken is told in words, and the last model stays', () =>
    withPage({}, async (page) => {
      const before = await contourAt(page, sampleHeight(154));
      await dropFile(page, 'broken.stl', Buffer.from('no model at all'));
      await page.waitForSelector('#problem:not([hidden])');
      assert.equal(await page.textContent('#problem-title'), 'broken.stl could not be opened');
      assert.match(await page.textContent('#problem-detail'), /^[A-Z].{10,}\.$/s);
      assert.equal(await page.textContent('#problem-kept'), 'bunny.stl is still open.');
      assert.equal(await fact(page, 'facts', 'Triangles'), '69,451');
      await slide(page, '#layer-slider', 20);
      assert.notEqual(await contourAt(page, sampleHeight(20)), before, 'the last model can still be cut');
      await page.keyboard.press('Escape');
      assert.ok(await page.isHidden('#problem'));
    }));

  test('that is cut short is told, whatever its length', () =>
    onPage(async (page) => {
      await dropFile(page, 'cut.stl', BOX.subarray(0, 90));
      await page.waitForSelector('#problem:not([hidden])');
      assert.equal(await page.textContent('#problem-title'), 'cut.stl could not be opened');
    }));
});

test('a large model is drawn once in each frame while it turns, twice when it rests, and nothing of it is sent again', () =>
  withPage({ hash: '#sample=teapot' }, async (page) => {
    const bytes = sphereStl(20, 230);
    const triangles = bytes.readUInt32LE(80);
    await page.setInputFiles('#file', { name: 'ball.stl', mimeType: 'model/stl', buffer: bytes });
    await shows(page, triangles.toLocaleString('en'));
    await settled(page);
    await page.uncheck('[data-item=layer]');
    const { frames, sent } = await page.evaluate(async (triangles) => {
      const { prototype } = WebGL2RenderingContext;
      const { drawElements, bufferData, bufferSubData } = prototype;
      // How often the model is drawn in each frame, by the frame's time.
      const drawn = new Map();
      let sent = 0;
      prototype.drawElements = function (mode, count, ...rest) {
        const time = document.timeline.currentTime;
        drawn.set(time, (drawn.get(time) ?? 0) + count / 3 / triangles);
        return drawElements.call(this, mode, count, ...rest);
      };
      prototype.bufferData = function (...values) {
        sent++;
        return bufferData.apply(this, values);
      };
      prototype.bufferSubData = function (...values) {
        sent++;
        return bufferSubData.apply(this, values);
      };
      const wait = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));
      const frames = () => [...drawn.values()].map(Math.round);
      // A slow machine may be at rest again before its next frame.
      for (let turn = 0; turn < 20 && !frames().includes(1); turn++) {
        const before = drawn.size;
        document.getElementById('canvas').dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft' }));
        for (let k = 0; k < 500 && (drawn.size === before || frames().at(-1) !== 2); k++) await wait(20);
      }
      await wait(500); // no more follows
      return { frames: frames(), sent };
    }, triangles);
    assert.ok(frames.includes(1), `while it turns it is drawn ${frames} times`);
    assert.ok(frames.every((times) => times === 1 || times === 2), `${frames}`);
    assert.equal(frames.at(-1), 2);
    assert.equal(sent, 0);
  }));

describe('a page without a model', () => {
  test('says what to do, after the first one was cancelled or could not be had', async () => {
    const context = await site.browser.newContext({ serviceWorkers: 'block' });
    const page = await context.newPage();
    let fail;
    const isAsked = new Promise((asked) => {
      void page.route('**/samples/teapot.obj', (route) => {
        fail = () => route.abort();
        asked();
      });
    });
    await page.goto(`${site.server.url}#sample=teapot`);
    await isAsked;
    assert.equal(await page.textContent('#job-label'), 'Opening teapot.obj');
    assert.ok(await page.isHidden('#empty'));
    await page.keyboard.press('Escape');
    await page.waitForSelector('#empty:not([hidden])');
    assert.equal(await page.textContent('#note'), 'Opening teapot.obj: cancelled');
    assert.ok(await page.isHidden('#problem'));
    for (const button of ['check', 'repair', 'voxelize', 'surface', 'offset', 'texture', 'prepare', 'halves']) assert.ok(await page.isDisabled(`#${button}`), button);

    fail = undefined;
    await page.reload();
    for (let k = 0; k < 1000 && !fail; k++) await page.waitForTimeout(20);
    await fail();
    await page.waitForSelector('#problem:not([hidden])');
    assert.equal(await page.textContent('#problem-title'), 'teapot.obj could not be opened');
    assert.match(await page.textContent('#problem-detail'), /^The server does not answer, .*\.$/);
    assert.ok(await page.isVisible('#empty'));
    await page.selectOption('#sample', 'dragon-points.ply');
    await settled(page);
    assert.ok(await page.isHidden('#empty'));
    await context.close();
  });
});

/** As in browsers without a graphics card that they trust. */
function refuseWebGl() {
  const { getContext } = HTMLCanvasElement.prototype;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    return kind.startsWith('webgl') ? null : getContext.call(this, kind, ...rest);
  };
}

test('without WebGL 2 the page says so where the view would be, and all else works', () =>
  withPage({ hash: '#sample=teapot', script: refuseWebGl }, async (page) => {
    await page.waitForSelector('#no-view:not([hidden])');
    assert.match(await page.textContent('#no-view'), /no 3D view: .* no WebGL 2\. All else works/);
    assert.equal(await page.isVisible('.view-tools'), false);
    assert.notEqual(await page.getAttribute('#plan-svg path', 'd'), '');
    for (const button of ['#repair', '#voxelize', '#surface']) await make(page, button);
    assert.equal(await page.locator('#results input').count(), 4, 'the model and three results');
    assert.equal(await page.isVisible('#problem'), false);
  }));
