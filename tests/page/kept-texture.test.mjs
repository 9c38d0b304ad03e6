/** A texture, when the page is loaded again: it is made again from what is kept. */
import assert from 'node:assert/strict';
import { describe, test } from 'node:test';
import { belongings, keeps, reload } from './kept.mjs';
import { dropFile, saved, settled, slide } from './page.mjs';
import { served } from './site.mjs';
import { another, BOX, drag, drawSeam, idle, makeTexture, ON_TOP, show, withModel as withModelOn } from './textures.mjs';

const site = served();

const withModel = (work) => withModelOn(site, BOX, work);

const RED = Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGP4z8DwHwAFAAH/iZk9HQAAAABJRU5ErkJggg==', 'base64');

/** All that the page says of its texture, and its file. */
async function all(page) {
  const texts = await Promise.all(['texture-facts', 'texture-picture', 'seam-list', 'affected', 'half-names'].map((id) => page.textContent(`#${id}`)));
  const stale = await page.isVisible('#seam-stale');
  const shown = await page.locator('input[name=texture-shown]:checked').getAttribute('value');
  return { texts, stale, shown, file: await saved(page, '#texture-download') };
}

/** Loads the page again, where a button is pressed once as soon as the texture is being made. */
async function leave(page, button) {
  await page.addInitScript((id) => {
    const isOnce = sessionStorage.getItem('pressed') === id;
    sessionStorage.setItem('pressed', id);
    new MutationObserver((_, observer) => {
      if (isOnce || document.getElementById('job-label')?.textContent !== 'Making the texture again') return;
      observer.disconnect();
      document.getElementById(id).click();
    }).observe(document, { subtree: true, childList: true, characterData: true });
  }, button);
  await page.reload();
  await settled(page);
}

describe('a texture', () => {
  test('is there again to the bit: of another offset than its field lines, cut along seams, with others drawn, and with its picture', () =>
    withModel(async (page) => {
      await makeTexture(page, 3);
      await another(page, async () => {
        await page.fill('#texture-exact', '4');
        await page.press('#texture-exact', 'Enter');
      });
      await dropFile(page, 'red.png', RED, '#texture-drop');
      await page.click('#seam-draw:enabled');
      await drawSeam(page, ...ON_TOP);
      await another(page, () => page.click('#flatten:enabled'));
      const cut = await all(page);
      assert.ok(!cut.stale);
      await keeps(page, 'picture', 'texture', 'view');
      await reload(page, 1);
      await idle(page);
      assert.deepEqual(await all(page), cut);

      await page.click('#seam-list button');
      await show(page, 'lines');
      const drawn = await all(page);
      assert.ok(drawn.stale);
      await keeps(page, 'picture', 'texture', 'view');
      await reload(page, 1);
      await idle(page);
      assert.deepEqual(await all(page), drawn);
      await page.click('#texture-checker');
      await keeps(page, 'texture', 'view');
    }));

  test('lets what a person wants meanwhile go first, and leaves it shown', () =>
    withModel(async (page) => {
      await slide(page, '#surface-resolution', 16);
      await makeTexture(page);
      await keeps(page, 'texture', 'view');
      await leave(page, 'surface');
      await page.waitForFunction(() => document.querySelectorAll('#results li button').length === 4);
      const order = await page.locator('#results .name').allTextContents();
      assert.deepEqual(order.slice(1), ['Surface', 'Textured']);
      await idle(page);
      assert.ok(await page.isChecked('[data-item=surface]'));
      assert.ok(!(await page.isChecked('[data-item=textured]')));
      await keeps(page, 'result', 'texture', 'view');
    }));

  test('that is made anew meanwhile takes the place of the one that was kept, with the picture', () =>
    withModel(async (page) => {
      await makeTexture(page);
      await dropFile(page, 'red.png', RED, '#texture-drop');
      await keeps(page, 'picture', 'texture', 'view');
      await leave(page, 'texture');
      await page.waitForSelector('#texture-result:not([hidden])');
      await idle(page);
      const before = await all(page);
      assert.equal(before.texts[1], 'red.png');
      await page.click('#texture-checker');
      await keeps(page, 'texture', 'view');
      await reload(page, 1);
      assert.equal(await page.textContent('#texture-picture'), 'a checker');
    }));

  test('that is cancelled while it is made again is forgotten; one that cannot be made is told', () =>
    withModel(async (page) => {
      await makeTexture(page);
      await keeps(page, 'texture', 'view');
      await leave(page, 'job-cancel');
      await page.waitForFunction(() => document.getElementById('note').textContent === 'Making the texture again: cancelled');
      await keeps(page);
      assert.ok(await page.isHidden('#problem'));
      await makeTexture(page);
      await keeps(page, 'texture', 'view');
      await belongings(page, "const { id } = all.find(({ kind }) => kind === 'texture'); const kept = await answer(contents.get(id)); kept.recipe.first.cone = 200; contents.put(kept, id);");
      await page.reload();
      await page.waitForSelector('#problem:not([hidden])');
      assert.equal(await page.textContent('#problem-title'), 'The texture could not be made again');
      assert.match(await page.textContent('#problem-detail'), /an angle from 10 to 80 is needed/);
      await keeps(page);
      assert.ok(await page.isEnabled('#texture'));
    }));
});
