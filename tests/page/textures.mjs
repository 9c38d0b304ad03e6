/** Textures on the page, in words the tests can use. */
import { boxStl } from './models.mjs';
import { fact, slide, withModel as onPage } from './page.mjs';

export const BOX = boxStl([0, 0, 0], [40, 30, 20]);

export const withModel = (site, bytes, work, options) => onPage(site, bytes, work, { ...options, unfolded: ['texture-block'] });

export async function idle(page) {
  await page.waitForSelector('#texture:enabled');
}

/** A texture with a coarse proxy, which is quick. */
export async function makeTexture(page, offset = 4) {
  await page.fill('#texture-exact', String(offset));
  await page.press('#texture-exact', 'Enter');
  await page.click('#texture:enabled');
  await page.waitForSelector('#texture-result:not([hidden])');
  await idle(page);
}

export function withTexture(site, work, options) {
  return withModel(
    site,
    BOX,
    async (page) => {
      await makeTexture(page);
      await work(page);
    },
    options,
  );
}

export async function show(page, what) {
  await page.locator(`input[name=texture-shown][value=${what}]`).check({ force: true });
}

/** The distance of the proxy, as it is told. */
export async function distance(page) {
  return parseFloat(await fact(page, 'texture-facts', 'Proxy'));
}

/** How many triangles the proxy has. */
export async function proxyTriangles(page) {
  return parseInt(/([\d,]+) triangles/.exec(await fact(page, 'texture-facts', 'Proxy'))[1].replaceAll(',', ''), 10);
}

/** Waits until the facts of the texture are other ones, and no job runs. */
export async function another(page, change) {
  const before = await page.textContent('#texture-facts');
  await change();
  await page.waitForFunction((before) => document.getElementById('texture-facts').textContent !== before, before);
  await idle(page);
}

/** Sets a slider, and lets go of it. */
export async function drag(page, selector, value) {
  await slide(page, selector, value);
  await page.locator(selector).dispatchEvent('change');
}

/** Millimetres. */
export async function seamLength(page) {
  const [, figure, unit] = /([\d.]+) (mm|m) of seams$/.exec(await fact(page, 'texture-facts', 'Charts'));
  return Number(figure) * (unit === 'm' ? 1000 : 1);
}

/** Clicks at a part of the width and of the height of the view. */
export async function clickView(page, x, y) {
  const box = await page.locator('#canvas').boundingBox();
  await page.mouse.click(box.x + x * box.width, box.y + y * box.height);
}

export async function drawSeam(page, ...places) {
  for (const place of places) await clickView(page, ...place);
  await page.waitForSelector('#seam-list li');
}

/** Two places in the view on the top of the box's proxy. */
export const ON_TOP = [[0.45, 0.27], [0.68, 0.31]];

/** What the canvas of the texture shows, as a data URL. */
export async function atlas(page) {
  return page.locator('#atlas').evaluate((canvas) => canvas.toDataURL());
}
