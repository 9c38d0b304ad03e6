/** What the browser keeps of models, in words the tests can use. */
import assert from 'node:assert/strict';
import { settled } from './page.mjs';

/** What the database has of things that belong to models, oldest first, as `edit` leaves them. */
export function belongings(page, edit = '') {
  return page.evaluate(async (edit) => {
    const answer = (request) => new Promise((resolve, reject) => Object.assign(request, { onsuccess: () => resolve(request.result), onerror: reject }));
    const database = await answer(indexedDB.open('fast-winding'));
    const transaction = database.transaction(['belongings', 'contents'], 'readwrite');
    // What is not committed when the page is left has not happened.
    const committed = new Promise((resolve, reject) => Object.assign(transaction, { oncomplete: resolve, onabort: reject }));
    const [things, contents] = ['belongings', 'contents'].map((name) => transaction.objectStore(name));
    const all = await answer(things.getAll());
    if (edit) await new (async () => {}).constructor('all', 'things', 'contents', 'answer', edit)(all, things, contents, answer);
    await committed;
    database.close();
    return all.map(({ kind, id, time }) => ({ kind, id, time })).sort((a, b) => a.time - b.time);
  }, edit);
}

/** Waits until these kinds are kept, in alphabetical order, and none is written any more. */
export async function keeps(page, ...kinds) {
  let [there, before] = [];
  for (let tries = 0; tries < 200; tries++) {
    [there, before] = [await belongings(page), there];
    const isWritten = JSON.stringify(there) === JSON.stringify(before);
    if (isWritten && kindsOf(there).join() === kinds.join()) return;
    await page.waitForTimeout(100);
  }
  assert.deepEqual(kindsOf(there), kinds);
}

const kindsOf = (things) => things.map(({ kind }) => kind).sort();

/** Loads the page again, and waits until so many results are listed. */
export async function reload(page, results) {
  await page.reload();
  await settled(page);
  await page.waitForFunction((count) => document.querySelectorAll('#results li button').length === 2 * count, results);
}
