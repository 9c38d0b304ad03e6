/** The service worker: threads on hosts that set no headers, the page without a network, and newer pages. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { describe, test } from 'node:test';
import { fact, make, number, openPage, settled, shows, slide, visit } from './page.mjs';
import { serve } from './serve.mjs';
import { served } from './site.mjs';

const site = served();

const isIsolated = (page) => page.evaluate(() => crossOriginIsolated);

/** Waits until something holds on the page, which may be a promise there, and which the page may be loaded again before. */
async function until(page, holds) {
  for (let tries = 0; tries < 600; tries++) {
    if (await page.evaluate(holds).catch(() => false)) return;
    await page.waitForTimeout(50);
  }
  assert.fail(`never: ${holds}`);
}

/** Waits until the worker has stored the page with all that it needs. */
function stored(page) {
  return until(page, async () => {
    const stores = await Promise.all((await caches.keys()).map((name) => caches.open(name)));
    return (await Promise.all(stores.map((store) => store.match('index.html')))).some(Boolean);
  });
}

/** A page, before it is loaded, which counts how often that happens. */
async function countedPage() {
  const context = await site.browser.newContext();
  const page = await context.newPage();
  page.loads = 0;
  page.on('domcontentloaded', () => page.loads++);
  return page;
}

describe('a host without headers', () => {
  test('gets an isolated page with threads after one reload, and after that needs no network', async () => {
    const host = await serve({ headers: {} });
    const page = await countedPage();
    await page.goto(host.url);
    await page.waitForFunction(() => crossOriginIsolated);
    await settled(page);
    assert.equal(page.loads, 2);
    const processors = await page.evaluate(() => navigator.hardwareConcurrency);
    assert.equal(await number(page, 'engine-facts', 'Threads') > 1, processors > 1);
    await stored(page);
    await host.close();

    await page.reload();
    await settled(page);
    assert.ok(await isIsolated(page));
    assert.equal(await fact(page, 'facts', 'Triangles'), '69,451');
    await page.click('#surface-block > summary');
    await slide(page, '#surface-resolution', 32);
    await make(page, '#surface');
    await page.selectOption('#sample', 'dragon.ply');
    await page.waitForSelector('#problem:not([hidden])');
    assert.match(await page.textContent('#problem-detail'), /was not opened here before/);
    await page.context().close();
  });

  test('is not left while the person is at work: threads run the next time', async () => {
    let release;
    const isUsed = new Promise((resolve) => (release = resolve));
    const host = await serve({ headers: {}, edit: (path) => (path === '/service-worker.js' ? isUsed : undefined) });
    const page = await countedPage();
    await page.goto(host.url);
    await settled(page);
    await page.keyboard.press('Tab');
    release();
    await page.waitForFunction(() => !document.getElementById('engine-later').hidden);
    assert.deepEqual([page.loads, await isIsolated(page)], [1, false]);
    await page.reload();
    await settled(page);
    assert.ok(await isIsolated(page));
    await page.context().close();
    await host.close();
  });

  test('whose own headers forbid isolation is not asked again and again', async () => {
    const host = await serve({ headers: { 'Cross-Origin-Embedder-Policy': 'unsafe-none' } });
    const page = await countedPage();
    await page.goto(host.url);
    await page.waitForFunction(() => navigator.serviceWorker.controller);
    await stored(page);
    await settled(page);
    assert.equal(await fact(page, 'engine-facts', 'Threads'), '1');
    assert.ok(page.loads <= 2, `loaded ${page.loads} times`);
    await page.context().close();
    await host.close();
  });
});

test('a newer page is shown at the next visit, and what is stored of the one before is removed', async () => {
  let isNew = false;
  const edit = (path, file) => {
    if (path === '/service-worker.js' && isNew) return readFileSync(file, 'utf8').replace(/"[0-9a-f]{12}"/, '"000000000001"');
    return path === '/index.html' && isNew ? readFileSync(file, 'utf8').replace('<title>', '<title>newer ') : undefined;
  };
  const host = await serve({ edit });
  const first = await openPage(site.browser, host.url, { serviceWorkers: 'allow', hash: '#sample=teapot' });
  const context = first.context();
  await stored(first);
  const [old] = await first.evaluate(() => caches.keys());
  isNew = true;
  const second = await visit(context, host.url);
  assert.match(await second.title(), /^newer/);
  await until(second, async () => (await navigator.serviceWorker.getRegistration()).waiting !== null);
  assert.ok((await second.evaluate(() => caches.keys())).includes(old), 'pages of the one before still have their files');
  await first.close();
  await second.close();
  const third = await visit(context, `${host.url}#sample=teapot`);
  await shows(third, '992');
  await until(third, async () => (await caches.keys()).join() === 'fast-winding-000000000001');
  await host.close();
  await third.reload();
  await shows(third, '992');
  assert.match(await third.title(), /^newer/);
  await context.close();
});
