/** Long work: its progress and its end, with threads and without, and an engine that dies over it. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { boxStl } from './models.mjs';
import { contourAt, drawnPixels, dropFile, fact, number, openPage, sampleHeight, saved, settled, shows, slide, withPage as onSite } from './page.mjs';
import { serve } from './serve.mjs';
import { served } from './site.mjs';

const site = served();

/** A box of 40 × 30 × 20 mm: its layers have an area of 1,200 mm² and a perimeter of 140 mm. */
const BOX = boxStl([0, 0, 0], [40, 30, 20]);

const withPage = (options, work) => onSite(site, options, work);

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
      const { name, bytes: stl } = await saved(page, '#voxel-download');
      assert.equal(name, 'box-voxels.stl');
      assert.equal(stl.length, 84 + 50 * stl.readUInt32LE(80));
      assert.ok(stl.readUInt32LE(80) > 1000);
    }));

  test('is cancelled by the button and by Escape, and the page goes on', () =>
    withPage({}, async (page) => {
      for (const event of ['click', 'keydown']) {
        await slide(page, '#voxel-resolution', 384);
        // As soon as it has come anywhere: from outside, the machine decides whether it ends before.
        await page.evaluate((type) => {
          const progress = document.getElementById('job-progress');
          const cancel = () => document.getElementById('job-cancel').dispatchEvent(type === 'click' ? new MouseEvent(type) : new KeyboardEvent(type, { key: 'Escape', bubbles: true }));
          new MutationObserver((_, observer) => {
            if (!progress.hasAttribute('value')) return;
            observer.disconnect();
            cancel();
          }).observe(progress, { attributes: true });
        }, event);
        await page.click('#voxelize');
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
      assert.equal((await saved(page, '#surface-download')).bytes.readUInt32LE(80), triangles);
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
