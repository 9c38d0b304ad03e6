/** What a person sees and does on the page, in words the tests can use. */
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { after, before } from 'node:test';

const FOLDS = ['check', 'repair', 'voxels', 'surface', 'offset', 'combine', 'texture', 'print', 'engine'].map((name) => `${name}-block`);

/**
 * Opens the page, with what folds unfolded, and waits until a sample is shown with its layer: the first, or what the address names after
 * its `#`. Without the service worker, unless it is wanted.
 */
export async function openPage(browser, url, { width = 1600, height = 900, unfolded = FOLDS, hash = '', serviceWorkers = 'block', script, ...options } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, acceptDownloads: true, serviceWorkers, ...options });
  await context.addInitScript((ids) => {
    if (!localStorage.getItem('fast-winding.open')) localStorage.setItem('fast-winding.open', JSON.stringify(ids));
  }, unfolded);
  if (script) await context.addInitScript(script);
  const page = await visit(context, url + hash);
  await settled(page);
  return page;
}

/** A new tab at an address; it may be loading still. */
export async function visit(context, url) {
  const page = await context.newPage();
  page.setDefaultTimeout(60_000);
  page.errors = [];
  page.on('pageerror', (error) => page.errors.push(error.message));
  await page.goto(url);
  return page;
}

/** Opens the page, and closes it when the work is done: without an uncaught error. */
export async function withPage({ browser, server }, options, work) {
  const page = await openPage(browser, server.url, options);
  try {
    await work(page);
    assert.deepEqual(page.errors, [], 'no uncaught error on the page');
  } finally {
    await page.context().close();
  }
}

/** One page for the tests of a suite, which do not mind what the one before has left; it has no uncaught error in the end. */
export function sharedPage(site, options, prepare = async () => {}) {
  const shared = {};
  before(async () => {
    shared.page = await openPage(site.browser, site.server.url, options);
    await prepare(shared.page);
  });
  after(async () => {
    assert.deepEqual(shared.page.errors, [], 'no uncaught error on the page');
    await shared.page.context().close();
  });
  return (work) => work(shared.page);
}

/** The smallest sample, for those who want another model anyway. */
const SMALLEST = '#sample=teapot';

/** Waits until no job runs and the layer of the plane is shown (or the model can have none). */
export async function settled(page) {
  await page.waitForFunction(() => {
    const has = (selector) => document.querySelector(selector) !== null;
    const isIdle = document.getElementById('job').hidden && has('#facts dd');
    return isIdle && (has('#layer-download:enabled') || !document.getElementById('orient-block').hidden);
  });
}

/** Opens the page with a model as the bytes of an STL file. */
export function withModel(site, bytes, work, options) {
  return withPage(site, { hash: SMALLEST, ...options }, async (page) => {
    await openModel(page, bytes);
    await work(page);
  });
}

/** The same for all tests of a suite, and with what else they need. */
export function sharedModel(site, bytes, options, prepare) {
  return sharedPage(site, { hash: SMALLEST, ...options }, async (page) => {
    await openModel(page, bytes);
    await prepare(page);
  });
}

async function openModel(page, bytes) {
  await dropFile(page, 'box.stl', bytes);
  await shows(page, bytes.readUInt32LE(80).toLocaleString('en'));
  await settled(page);
}

/** Waits until the model has so many triangles or points, as they are written. */
export async function shows(page, count) {
  await page.waitForFunction((count) => document.querySelector('#facts dd')?.textContent === count, count);
}

/** Presses the button of a tool, and waits until there is a result more, or another one in its place. */
export async function make(page, button) {
  const newest = () => page.evaluate(() => Math.max(0, ...[...document.querySelectorAll('#results input')].map((input) => Number(input.value))));
  const before = await newest();
  await page.click(`${button}:enabled`);
  await page.waitForFunction((before) => [...document.querySelectorAll('#results input')].some((input) => Number(input.value) > before), before);
  await page.waitForSelector('#job', { state: 'hidden' });
}

/** The value beside a name in one of the lists of facts. */
export async function fact(page, list, name) {
  return page.evaluate(
    ([list, name]) => [...document.querySelectorAll(`#${list} dt`)].find((term) => term.textContent === name)?.nextElementSibling.textContent,
    [list, name],
  );
}

export async function number(page, list, name) {
  return parseFloat((await fact(page, list, name)).replaceAll(',', '').replace('−', '-'));
}

/** Drops a file on the page, or on a part of it, as a browser does: with a DataTransfer that holds it. */
export async function dropFile(page, name, bytes, selector = 'body') {
  const transfer = await page.evaluateHandle(
    ([name, base64]) => {
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      const transfer = new DataTransfer();
      transfer.items.add(new File([bytes], name));
      return transfer;
    },
    [name, bytes.toString('base64')],
  );
  await page.dispatchEvent(selector, 'dragover', { dataTransfer: transfer });
  await page.dispatchEvent(selector, 'drop', { dataTransfer: transfer });
}

/** Sets a slider as a person who lets go of it would. */
export async function slide(page, selector, value) {
  await page.locator(selector).evaluate((slider, value) => {
    slider.value = String(value);
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  }, value);
}

/** The path of the layer sampled at height `z`, once it is shown. */
export async function contourAt(page, z) {
  await page.waitForFunction((z) => {
    const shown = document.querySelector('#plan-svg .contour')?.dataset.z;
    return shown && Math.abs(Number(shown) - z) < 1e-3;
  }, z);
  return page.getAttribute('#plan-svg .contour', 'd');
}

/** Height at which the sample's layer `index` is sampled: its lowest point, and half a millimetre a layer. */
export function sampleHeight(index) {
  return 32.9874 + 0.5 * (index + 0.5);
}

/** Which part of the pixels of the 3D view differs from its background. */
export async function drawnPixels(page) {
  const { width, height, data } = await viewPixels(page);
  let drawn = 0;
  for (let i = 3; i < data.length; i += 4) if (data[i] > 128) drawn++;
  return drawn / (width * height);
}

/** Whether something that has a colour, as grey and the floor have not, reaches the sides of the 3D view. */
export async function reachesSides(page) {
  const { width, height, data } = await viewPixels(page);
  const isColoured = (x, y) => {
    const [red, green, blue, alpha] = data.slice(4 * (y * width + x), 4 * (y * width + x) + 4);
    return alpha > 128 && Math.max(red, green, blue) - Math.min(red, green, blue) > 40;
  };
  for (let x = 0; x < width; x++) if (isColoured(x, 0) || isColoured(x, height - 1)) return true;
  for (let y = 0; y < height; y++) if (isColoured(0, y) || isColoured(width - 1, y)) return true;
  return false;
}

/** Every fourth pixel of the 3D view, along both sides: of one frame, sooner there than a `picture`. */
export async function viewPixels(page) {
  return page.evaluate(async () => {
    const canvas = document.getElementById('canvas');
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [canvas.width / 4, canvas.height / 4];
    const context = copy.getContext('2d');
    // A canvas of WebGL can be read only in the frame in which it was drawn; a turn there and back draws it.
    const key = (name) => canvas.dispatchEvent(new KeyboardEvent('keydown', { key: name, bubbles: true }));
    key('ArrowLeft');
    key('ArrowRight');
    await new Promise((resolve) => requestAnimationFrame(resolve));
    context.drawImage(canvas, 0, 0, copy.width, copy.height);
    const { width, height, data } = context.getImageData(0, 0, copy.width, copy.height);
    return { width, height, data: [...data] };
  });
}

/** What the 3D view shows, once it is drawn. */
export async function picture(page) {
  // A button under the mouse would look otherwise.
  await page.mouse.move(0, 0);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return (await page.locator('#canvas').screenshot()).toString('base64');
}

/** Names of controls and figures that reach beyond the sides of the page. */
export function outside(page) {
  return page.evaluate(() =>
    [...document.querySelectorAll('button, input:not([hidden]), select, dd, td, output')]
      .filter((element) => element.getClientRects().length > 0)
      .filter((element) => element.getBoundingClientRect().right > innerWidth || element.getBoundingClientRect().left < 0)
      .map((element) => element.id || element.textContent),
  );
}

/** What a click on a button saves. */
export async function saved(page, selector) {
  const [file] = await Promise.all([page.waitForEvent('download'), page.click(selector)]);
  return { name: file.suggestedFilename(), bytes: await readFile(await file.path()) };
}
