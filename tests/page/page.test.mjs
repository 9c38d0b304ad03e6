import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { describe, test } from 'node:test';
import { boxObj, boxStl, sphereStl } from './models.mjs';
import { contourAt, drawnPixels, dropFile, fact, number, openPage, sampleHeight, settled, sharedPage, shows, slide, withPage as onSite } from './page.mjs';
import { serve } from './serve.mjs';
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

describe('the plane', () => {
  const onPage = sharedPage(site);

  test('is saved as SVG', () =>
    onPage(async (page) => {
      const [file] = await Promise.all([page.waitForEvent('download'), page.click('#layer-download')]);
      assert.match(file.suggestedFilename(), /^bunny-z.*\.svg$/);
      const text = await readFile(await file.path(), 'utf8');
      assert.match(text, /<svg[^>]*>/);
      assert.match(text, /<path|<polygon/);
    }));

  test('moves its contour, and follows a fast slider to its last place', () =>
    onPage(async (page) => {
      const before = await contourAt(page, sampleHeight(154));
      for (let index = 30; index <= 60; index++) await slide(page, '#layer-slider', index);
      const after = await contourAt(page, sampleHeight(60));
      assert.notEqual(after, before);
      assert.equal(await page.textContent('#layer-z'), 'z = 63.2 mm');
      await slide(page, '#layer-slider', 61);
      await contourAt(page, sampleHeight(61));
      await slide(page, '#layer-slider', 60);
      assert.equal(await contourAt(page, sampleHeight(60)), after, 'the same height gives the same contour');
    }));

  test('keeps its height when the layer height changes', () =>
    onPage(async (page) => {
      assert.equal(await page.textContent('#layer-out'), 'layer 61 of 309');
      await page.fill('#layer-height', '1');
      await page.press('#layer-height', 'Enter');
      assert.equal(await page.textContent('#layer-out'), 'layer 31 of 155');
      await page.fill('#layer-height', '-3');
      await page.press('#layer-height', 'Enter');
      assert.equal(await page.inputValue('#layer-height'), '1', 'a height that makes no sense is taken back');
    }));

  test('shows w as colours, 1 in the middle of a box and 0 beside it', () =>
    onPage(async (page) => {
      await dropFile(page, 'box.stl', BOX);
      await shows(page, '12');
      await settled(page);
      await page.check('#heat');
      await page.waitForSelector('#plan-svg image', { state: 'attached' });
      assert.deepEqual(await page.locator('#legend-ticks span').allTextContents(), ['1/2', '0', '1']);
      const box = await page.locator('#plan').boundingBox();
      const wAt = async (x, y) => {
        await page.mouse.move(box.x + x * box.width, box.y + y * box.height);
        return Number(/w (-?[\d.]+)/.exec(await page.textContent('#plan-readout'))[1]);
      };
      assert.ok(Math.abs((await wAt(0.5, 0.5)) - 1) < 0.01);
      assert.ok(Math.abs(await wAt(0.05, 0.5)) < 0.01);
      await page.uncheck('#heat');
      await page.waitForSelector('#plan-svg image', { state: 'detached' });
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
    const { times, sent } = await page.evaluate(async (triangles) => {
      const { prototype } = WebGL2RenderingContext;
      const { drawElements, bufferData, bufferSubData } = prototype;
      let [drawn, sent] = [0, 0];
      prototype.drawElements = function (mode, count, ...rest) {
        drawn += count / 3;
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
      const times = () => Math.round(drawn / triangles);
      document.getElementById('canvas').dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft' }));
      for (let k = 0; k < 1000 && times() < 3; k++) await wait(20);
      await wait(500); // no more follows
      return { times: times(), sent };
    }, triangles);
    assert.equal(times, 1 + 2);
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

describe('long work', () => {
  test('shows progress and ends in voxels whose volume is the box', () =>
    withPage({}, async (page) => {
      await dropFile(page, 'box.stl', BOX);
      await shows(page, '12');
      await settled(page);
      await watchJobs(page);
      await page.click('#voxelize');
      await page.waitForSelector('#voxel-facts dd');
      assert.ok((await jobsSeen(page)).some((label) => label === 'Voxels'), 'the job was announced');
      const volume = await number(page, 'voxel-facts', 'Volume');
      assert.ok(Math.abs(volume - 24) < 0.5, `24 cm³, got ${volume}`);
      assert.ok(await page.isChecked('[data-item=voxels]'));
      assert.ok(!(await page.isChecked('[data-item=model]')), 'the model makes room for its voxels');
      const [file] = await Promise.all([page.waitForEvent('download'), page.click('#voxel-download')]);
      assert.equal(file.suggestedFilename(), 'box-voxels.stl');
      const stl = await readFile(await file.path());
      assert.equal(stl.length, 84 + 50 * stl.readUInt32LE(80));
      assert.ok(stl.readUInt32LE(80) > 1000);
    }));

  test('is cancelled by the button and by Escape, and the page goes on', () =>
    withPage({}, async (page) => {
      // At once: the job may end while the button is still moving into place.
      for (const cancel of [() => page.dispatchEvent('#job-cancel', 'click'), () => page.keyboard.press('Escape')]) {
        await slide(page, '#voxel-resolution', 384);
        await page.click('#voxelize');
        await page.waitForSelector('#job:not([hidden])');
        await cancel();
        await page.waitForSelector('#job', { state: 'hidden' });
        assert.equal(await page.locator('#voxel-facts dd').count(), 0);
        assert.ok(await page.isHidden('#problem'), 'cancelling is no error');
      }
      await slide(page, '#layer-slider', 200);
      assert.match(await contourAt(page, sampleHeight(200)), /^M/);
      await slide(page, '#voxel-resolution', 32);
      await page.click('#voxelize');
      await page.waitForSelector('#voxel-facts dd');
    }));

  test('leaves the page responsive', () =>
    withPage({}, async (page) => {
      await slide(page, '#voxel-resolution', 256);
      const longest = await page.evaluate(async () => {
        document.getElementById('voxelize').click();
        let [last, longest] = [performance.now(), 0];
        while (!document.getElementById('job').hidden) {
          await new Promise((resolve) => setTimeout(resolve, 0));
          const now = performance.now();
          longest = Math.max(longest, now - last);
          last = now;
          if (document.getElementById('job-progress').value > 0.5) break;
        }
        return longest;
      });
      assert.ok(longest < 500, `the page stood still for ${longest} ms`);
    }));
});

describe('the surface', () => {
  test('of a broken scan is made, shown and saved', () =>
    withPage({}, async (page) => {
      await slide(page, '#surface-resolution', 64);
      await page.click('#surface');
      await page.waitForSelector('#surface-facts dd');
      const triangles = await number(page, 'surface-facts', 'Triangles');
      const vertices = await number(page, 'surface-facts', 'Vertices');
      assert.equal(triangles % 2, 0, 'a closed surface has an even number of triangles');
      assert.ok(Math.abs(triangles - 2 * vertices) < 100, 'Euler: about two triangles a vertex');
      assert.ok((await drawnPixels(page)) > 0.1);
      const [file] = await Promise.all([page.waitForEvent('download'), page.click('#surface-download')]);
      assert.equal((await readFile(await file.path())).readUInt32LE(80), triangles);
    }));
});

describe('without cross-origin isolation', () => {
  test('the page works on one thread, says why, and survives a cancel', async () => {
    const plain = await serve({ isolated: false });
    const page = await openPage(site.browser, plain.url);
    try {
      assert.equal(await page.evaluate(() => crossOriginIsolated), false);
      assert.equal(await fact(page, 'engine-facts', 'Threads'), '1');
      assert.match(await page.textContent('#engine-reason'), /not cross-origin isolated/);
      assert.equal(await fact(page, 'facts', 'Triangles'), '69,451');
      await slide(page, '#voxel-resolution', 384);
      await page.click('#voxelize');
      await page.waitForSelector('#job:not([hidden])');
      await page.keyboard.press('Escape');
      await page.waitForSelector('#job', { state: 'hidden' });
      await slide(page, '#voxel-resolution', 32);
      await page.click('#voxelize');
      await page.waitForSelector('#voxel-facts dd');
      assert.deepEqual(page.errors, []);
    } finally {
      await page.context().close();
      await plain.close();
    }
  });
});

describe('an engine that dies', () => {
  test('is told, replaced and given the model again', () =>
    withPage({}, async (page) => {
      const engine = page.workers().find((worker) => /worker-|worker\.js/.test(worker.url()) && !worker.url().includes('pool'));
      await engine.evaluate(() => {
        setTimeout(() => {
          throw new Error('broken on purpose');
        });
      });
      await slide(page, '#layer-slider', 100);
      await page.waitForSelector('#problem:not([hidden])');
      assert.match(await page.textContent('#problem-detail'), /broken on purpose/);
      await slide(page, '#layer-slider', 30);
      assert.match(await contourAt(page, sampleHeight(30)), /^M/);
      await slide(page, '#voxel-resolution', 32);
      await page.click('#voxelize');
      await page.waitForSelector('#voxel-facts dd');
    }));
});

/** Notes each label that the progress card shows from now on. */
async function watchJobs(page) {
  await page.evaluate(() => {
    window.jobsSeen = [];
    const label = document.getElementById('job-label');
    new MutationObserver(() => window.jobsSeen.push(label.textContent)).observe(label, { childList: true, characterData: true, subtree: true });
  });
}

async function jobsSeen(page) {
  return page.evaluate(() => window.jobsSeen);
}
