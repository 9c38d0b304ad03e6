/** Textures of soups: charts, seams, field lines, pictures, and the files that other programs read. */
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { describe, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { SIDES, boxStl, sphereStl, sphereXyz, together } from './models.mjs';
import { dropFile, fact, openPage, outside, picture, reachesSides, saved, settled, sharedModel, slide, withModel as onPage } from './page.mjs';
import { serve } from './serve.mjs';
import { served } from './site.mjs';

const require = createRequire(new URL('../../www/package.json', import.meta.url));
const { unzipSync } = await import(pathToFileURL(require.resolve('three/examples/jsm/libs/fflate.module.js')));

const site = served();

const BOX = boxStl([0, 0, 0], [40, 30, 20]);

const withModel = (bytes, work, options) => onPage(site, bytes, work, { ...options, unfolded: ['texture-block'] });

async function idle(page) {
  await page.waitForSelector('#texture:enabled');
}

/** A texture with a coarse proxy, which is quick. */
async function makeTexture(page, offset = 4) {
  await page.fill('#texture-exact', String(offset));
  await page.press('#texture-exact', 'Enter');
  await page.click('#texture:enabled');
  await page.waitForSelector('#texture-result:not([hidden])');
  await idle(page);
}

function withTexture(work, options) {
  return withModel(
    BOX,
    async (page) => {
      await makeTexture(page);
      await work(page);
    },
    options,
  );
}

async function show(page, what) {
  await page.locator(`input[name=texture-shown][value=${what}]`).check({ force: true });
}

/** The distance of the proxy, as it is told. */
async function distance(page) {
  return parseFloat(await fact(page, 'texture-facts', 'Proxy'));
}

/** How many triangles the proxy has. */
async function proxyTriangles(page) {
  return parseInt(/([\d,]+) triangles/.exec(await fact(page, 'texture-facts', 'Proxy'))[1].replaceAll(',', ''), 10);
}

/** Waits until the facts of the texture are other ones, and no job runs. */
async function another(page, change) {
  const before = await page.textContent('#texture-facts');
  await change();
  await page.waitForFunction((before) => document.getElementById('texture-facts').textContent !== before, before);
  await idle(page);
}

/** Sets a slider, and lets go of it. */
async function drag(page, selector, value) {
  await slide(page, selector, value);
  await page.locator(selector).dispatchEvent('change');
}

/** Millimetres. */
async function seamLength(page) {
  const [, figure, unit] = /([\d.]+) (mm|m) of seams$/.exec(await fact(page, 'texture-facts', 'Charts'));
  return Number(figure) * (unit === 'm' ? 1000 : 1);
}

/** Clicks at a part of the width and of the height of the view. */
async function clickView(page, x, y) {
  const box = await page.locator('#canvas').boundingBox();
  await page.mouse.click(box.x + x * box.width, box.y + y * box.height);
}

async function drawSeam(page, ...places) {
  for (const place of places) await clickView(page, ...place);
  await page.waitForSelector('#seam-list li');
}

/** Two places in the view on the top of the box's proxy. */
const ON_TOP = [[0.45, 0.27], [0.68, 0.31]];

/** What the canvas of the texture shows, as a data URL. */
async function atlas(page) {
  return page.locator('#atlas').evaluate((canvas) => canvas.toDataURL());
}

/** A PNG of one colour. */
async function png(page, width, height, colour) {
  const url = await page.evaluate(
    ([width, height, colour]) => {
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [width, height];
      const context = canvas.getContext('2d');
      context.fillStyle = colour;
      context.fillRect(0, 0, width, height);
      return canvas.toDataURL('image/png');
    },
    [width, height, colour],
  );
  return Buffer.from(url.slice(url.indexOf(',') + 1), 'base64');
}

/** The JSON chunk of a binary glTF. */
function gltfOf(bytes) {
  assert.equal(bytes.subarray(0, 4).toString('latin1'), 'glTF');
  assert.equal(bytes.readUInt32LE(4), 2);
  assert.equal(bytes.readUInt32LE(8), bytes.length);
  return JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());
}

/** The texture coordinates of a binary glTF. */
function coordinatesOf(bytes) {
  const { meshes, accessors, bufferViews } = gltfOf(bytes);
  const { bufferView, byteOffset = 0, count } = accessors[meshes[0].primitives[0].attributes.TEXCOORD_0];
  const { byteOffset: start = 0, byteStride = 8 } = bufferViews[bufferView];
  const first = 20 + bytes.readUInt32LE(12) + 8 + start + byteOffset;
  return Array.from({ length: count }, (_, k) => [0, 4].map((next) => bytes.readFloatLE(first + k * byteStride + next)));
}

describe('a texture', () => {
  test('of a sphere covers all its triangles, which is told in words and figures', () =>
    withModel(sphereStl(20, 12), async (page) => {
      assert.match(await page.textContent('#texture-suggested'), /3 % of the longest side, 1\.2 mm/);
      assert.ok(await page.isHidden('#texture-result'));
      const before = await picture(page);
      await makeTexture(page);
      assert.notEqual(await picture(page), before);
      assert.ok(await page.isChecked('input[name=texture-shown][value=textured]'));
      const verdict = await page.textContent('#texture-verdict-text');
      const doubtful = Number(verdict.match(/^(\d+) triangles? of 528 may reach beyond/)?.[1] ?? 0);
      assert.ok(doubtful <= 5, verdict);
      if (!doubtful) assert.equal(verdict, 'All 528 triangles have their part of the picture.');
      assert.equal(await page.getAttribute('#texture-verdict', 'data-rating'), doubtful ? 'caution' : 'good');
      assert.equal(await distance(page), 4);
      assert.match(await fact(page, 'texture-facts', 'Charts'), /^\d+, [\d.]+ mm of seams$/);
      const share = parseFloat(await fact(page, 'texture-facts', 'Of the picture used'));
      assert.ok(share > 20 && share <= 100, `${share} % of the picture`);
      const [mean, most] = (await fact(page, 'texture-facts', 'Stretched, mean and most')).split(', ').map(Number);
      assert.ok(mean >= 1 && mean < 1.5 && most >= mean, `stretched by ${mean}, ${most} at most`);
    }));

  test('of triangles that are too large for it is told to be a doubtful one', () =>
    withTexture(async (page) => {
      assert.match(await page.textContent('#texture-verdict-text'), /^\d+ triangles of 12 (are not textured well|may reach beyond their charts)\.$/);
      assert.equal(await page.getAttribute('#texture-verdict', 'data-rating'), 'alarm');
      const reasons = await page.locator('#texture-verdict-reasons li').allTextContents();
      assert.ok(reasons.some((reason) => /^\d+ triangles lay across seams; .* moved into one chart\.$/.test(reason)), reasons.join(' '));
      assert.equal(new Set(reasons).size, reasons.length);
    }));

  test('shows its charts, and field lines that can be stopped', () =>
    withTexture(async (page) => {
      const textured = await picture(page);
      const plain = await atlas(page);
      await show(page, 'charts');
      const charts = await picture(page);
      assert.notEqual(charts, textured);
      assert.notEqual(await atlas(page), plain, 'the picture has the colours of the charts');
      assert.ok(await page.isHidden('#texture-flow-row'));
      await show(page, 'lines');
      assert.ok(await page.isChecked('[data-item=fieldLines]'));
      const moving = await picture(page);
      assert.notEqual(moving, charts);
      // In motion: it becomes another one, however long that takes.
      let tries = 0;
      while ((await picture(page)) === moving) assert.ok(tries++ < 50, 'nothing moves');
      await page.click('#texture-flow');
      const still = await picture(page);
      await page.waitForTimeout(400);
      assert.equal(await picture(page), still, 'they are at rest');
      assert.equal(await page.textContent('#texture-flow'), 'Set in motion');
    }));

  test('has field lines at rest for those who want less motion', () =>
    withModel(BOX, async (page) => {
      await page.emulateMedia({ reducedMotion: 'reduce' });
      await makeTexture(page);
      await show(page, 'lines');
      assert.equal(await page.textContent('#texture-flow'), 'Set in motion');
      const still = await picture(page);
      await page.waitForTimeout(400);
      assert.equal(await picture(page), still);
    }));

  test('is mapped anew when the proxy comes nearer, to the same lines', () =>
    withTexture(async (page) => {
      const lines = await fact(page, 'texture-facts', 'Field lines');
      await drag(page, '#texture-offset', 50);
      await page.waitForFunction(() => document.querySelector('#texture-facts dd').textContent.startsWith('3 mm'));
      await idle(page);
      assert.equal(await fact(page, 'texture-facts', 'Field lines'), lines);
      assert.equal(await page.inputValue('#texture-exact'), '3');
    }));

  test('has a proxy that is smoothed, for the same lines', () =>
    withTexture(async (page) => {
      await page.click('#texture-block details summary');
      const lines = await fact(page, 'texture-facts', 'Field lines');
      const [triangles, length] = [await proxyTriangles(page), await seamLength(page)];
      await another(page, () => drag(page, '#texture-smoothing', 10));
      assert.equal(await proxyTriangles(page), triangles, 'smoothing moves vertices alone');
      assert.notEqual(await seamLength(page), length);
      assert.equal(await fact(page, 'texture-facts', 'Field lines'), lines);
    }));

  test('has a proxy that goes in where its model is open, if that is wanted', () =>
    withModel(boxStl([0, 0, 0], [40, 30, 20], { without: SIDES.top }), async (page) => {
      await makeTexture(page, 2);
      const outer = await proxyTriangles(page);
      await page.click('#texture-block details summary');
      await another(page, () => page.check('#texture-both'));
      const both = await proxyTriangles(page);
      // Instead of a lid over the opening of 36 × 26 mm, the proxy has the inner sides of the walls, 18 mm high, and of the bottom.
      const box = 2 * (44 * 34 + 44 * 24 + 34 * 24);
      const ratio = (box + 2 * 18 * (36 + 26)) / box;
      assert.ok(Math.abs(both / outer / ratio - 1) < 0.05, `${both} triangles for two sides, ${outer} for one, whose areas are as ${ratio} to 1`);
    }));

  test('splits triangles that cross before, if that is wanted', () =>
    withModel(together(BOX, boxStl([10, 10, 10], [30, 20, 50])), async (page) => {
      const textured = async () => parseInt(/(?:of|All) ([\d,]+)/.exec(await page.textContent('#texture-verdict-text'))[1].replaceAll(',', ''), 10);
      await makeTexture(page);
      assert.equal(await textured(), 24);
      await page.click('#texture-block details summary');
      await page.check('#texture-refine');
      await another(page, () => page.click('#texture:enabled'));
      assert.ok((await textured()) > 24, `${await textured()} triangles`);
    }));

  test('stays as it was when another mapping is cancelled', () =>
    withTexture(async (page) => {
      const [facts, view] = [await page.textContent('#texture-facts'), await picture(page)];
      await page.click('#texture-block details summary');
      await page.check('#texture-both');
      await page.keyboard.press('Escape');
      await idle(page);
      await page.fill('#texture-exact', '0.3');
      await page.press('#texture-exact', 'Enter');
      await page.waitForSelector('#job:not([hidden])');
      await page.keyboard.press('Escape');
      await idle(page);
      assert.equal(await page.textContent('#note'), 'Texture: cancelled');
      assert.equal(await page.textContent('#texture-facts'), facts);
      assert.equal(await page.inputValue('#texture-exact'), '4');
      assert.ok(!(await page.isChecked('#texture-both')));
      assert.equal(await picture(page), view);
    }));

  test('is wholly in view when the view is fitted, with its proxy while that is shown', () =>
    withModel(BOX, async (page) => {
      await makeTexture(page, 15);
      await page.uncheck('[data-item=layer]');
      await show(page, 'charts');
      assert.ok(await reachesSides(page), 'the view is of the model, which the proxy is far larger than');
      await page.click('[data-view=fit]');
      assert.ok(!(await reachesSides(page)));
    }));

  test('is made, mapped anew and cancelled on one thread too', async () => {
    const plain = await serve({ isolated: false });
    try {
      const work = async (page) => {
        await makeTexture(page);
        assert.equal(await page.evaluate(() => crossOriginIsolated), false);
        await another(page, () => drag(page, '#texture-offset', 50));
        assert.equal(await distance(page), 3);
        await page.fill('#texture-exact', '0.3');
        await page.press('#texture-exact', 'Enter');
        await page.waitForSelector('#job:not([hidden])');
        await page.keyboard.press('Escape');
        await idle(page);
        assert.equal(await distance(page), 3);
        await another(page, () => drag(page, '#texture-offset', 80));
        assert.equal(await distance(page), 4.8);
        assert.equal((await saved(page, '#texture-download')).name, 'box-textured.glb');
      };
      await onPage({ ...site, server: plain }, BOX, work, { unfolded: ['texture-block'] });
    } finally {
      await plain.close();
    }
  });

  test('has the least distance suggested that one proxy needs', () =>
    withModel(BOX, async (page) => {
      await page.click('#texture-suggest:enabled');
      await page.waitForFunction(() => document.getElementById('texture-suggested').textContent.startsWith('From'));
      // A closed box is in one piece at the least distance that is tried, 1/80 of its longest side.
      assert.equal(await page.inputValue('#texture-exact'), '0.5');
    }));

  test('is none of points, which is told', async () => {
    const page = await openPage(site.browser, site.server.url, { unfolded: ['texture-block'] });
    try {
      await dropFile(page, 'points.xyz', sphereXyz(500, 10));
      await page.waitForSelector('#texture-cloud:not([hidden])');
      assert.ok(await page.isDisabled('#texture'));
    } finally {
      await page.context().close();
    }
  });

  test('that is cancelled leaves the page as it was', async () => {
    const page = await openPage(site.browser, site.server.url, { unfolded: ['texture-block'] });
    try {
      await page.click('#texture:enabled');
      await page.waitForSelector('#job:not([hidden])');
      await page.keyboard.press('Escape');
      await idle(page);
      assert.ok(await page.isHidden('#texture-result'));
      assert.ok(await page.isHidden('#problem'));
      assert.deepEqual(page.errors, []);
    } finally {
      await page.context().close();
    }
  });

  test('goes with the model that it is of', () =>
    withTexture(async (page) => {
      await dropFile(page, 'other.stl', boxStl([0, 0, 0], [10, 10, 10]));
      await page.waitForSelector('#texture-result', { state: 'hidden' });
      await settled(page);
      assert.equal(await page.locator('[data-item=textured]').isVisible(), false);
    }));
});

describe('charts', () => {
  test('are told to be stale when they are to turn by another angle, until they are laid flat again', () =>
    withTexture(async (page) => {
      assert.ok(await page.isHidden('#seam-stale'));
      await drag(page, '#texture-cone', 30);
      assert.ok(await page.isVisible('#seam-stale'));
      await another(page, () => page.click('#flatten:enabled'));
      assert.ok(await page.isHidden('#seam-stale'));
    }));
});

describe('seams', () => {
  test('are drawn by two clicks, listed, taken back, and cut the charts', () =>
    withTexture(async (page) => {
      const before = await seamLength(page);
      await page.click('#seam-draw:enabled');
      assert.equal(await page.getAttribute('#seam-draw', 'aria-pressed'), 'true');
      assert.ok(await page.isChecked('input[name=texture-shown][value=charts]'));
      const charts = await picture(page);
      await drawSeam(page, ...ON_TOP);
      assert.match(await page.textContent('#seam-list li'), /^Seam 1, [\d.]+ mm/);
      assert.notEqual(await picture(page), charts, 'the seam is drawn');
      assert.ok(await page.isVisible('#seam-stale'));
      await page.click('#seam-undo');
      assert.equal(await page.locator('#seam-list li').count(), 0);
      await drawSeam(page, ...ON_TOP);
      await page.click('#flatten:enabled');
      await page.waitForSelector('#seam-stale', { state: 'hidden' });
      await idle(page);
      const after = await seamLength(page);
      assert.ok(after > before, `${after} mm of seams, ${before} mm without the one that was drawn`);
      await page.click('#seam-list button');
      assert.ok(await page.isVisible('#seam-stale'));
      await page.click('#seam-draw:enabled');
      assert.equal(await page.getAttribute('#seam-draw', 'aria-pressed'), 'false');
    }));

  test('are led on from their ends, in one piece', () =>
    withTexture(async (page) => {
      await page.click('#seam-draw:enabled');
      await drawSeam(page, ...ON_TOP);
      const length = async () => parseFloat((await page.textContent('#seam-list li')).split(', ')[1]);
      const before = await length();
      await clickView(page, ...ON_TOP[1]);
      await clickView(page, 0.6, 0.24);
      await page.waitForFunction((before) => !document.querySelector('#seam-list li').textContent.includes(`, ${before} mm`), before);
      assert.equal(await page.locator('#seam-list li').count(), 1);
      assert.ok((await length()) > before);
      await page.click('#seam-undo');
      assert.equal(await length(), before);
    }));

  test('are drawn with the keys alone', () =>
    withTexture(async (page) => {
      await page.focus('#seam-draw');
      await page.keyboard.press('Enter');
      assert.equal(await page.evaluate(() => document.activeElement.id), 'canvas');
      await page.keyboard.press('Enter');
      assert.match(await page.textContent('#seam-hint'), /^Click where it ends/);
      for (let k = 0; k < 3; k++) await page.keyboard.press('ArrowRight');
      await page.keyboard.press('Enter');
      await page.waitForSelector('#seam-list li');
      assert.equal(await page.locator('#seam-list li').count(), 1);
    }));

  test('stay between the same places when the proxy changes', () =>
    withTexture(async (page) => {
      await page.click('#seam-draw:enabled');
      await drawSeam(page, ...ON_TOP);
      const length = async () => parseFloat((await page.textContent('#seam-list li')).split(', ')[1]);
      const before = await length();
      await page.fill('#texture-exact', '3');
      await page.press('#texture-exact', 'Enter');
      await page.waitForFunction(() => document.querySelector('#texture-facts dd').textContent.startsWith('3 mm'));
      await page.waitForSelector('#seam-stale', { state: 'hidden' });
      await idle(page);
      assert.equal(await page.locator('#seam-list li').count(), 1);
      assert.ok(Math.abs((await length()) - before) < 0.4 * before, `${await length()} mm after ${before} mm`);
    }));
});

describe('the picture of a texture', () => {
  const onTexture = sharedModel(site, BOX, { unfolded: ['texture-block'] }, (page) => makeTexture(page));

  test('is an image that is dropped, and a checker again', () =>
    onTexture(async (page) => {
      const checker = await picture(page);
      const plain = await atlas(page);
      await dropFile(page, 'red.png', await png(page, 64, 32, '#c03020'), '#texture-drop');
      await page.waitForFunction(() => document.getElementById('texture-picture').textContent === 'red.png');
      assert.notEqual(await picture(page), checker);
      assert.notEqual(await atlas(page), plain);
      assert.equal(await fact(page, 'facts', 'Triangles'), '12', 'the model is the same');
      await page.click('#texture-checker');
      assert.equal(await page.textContent('#texture-picture'), 'a checker');
      assert.equal(await picture(page), checker);
    }));

  test('is no file of another kind, which is told', () =>
    onTexture(async (page) => {
      await dropFile(page, 'words.txt', Buffer.from('no picture'), '#texture-drop');
      await page.waitForSelector('#problem:not([hidden])');
      assert.equal(await page.textContent('#problem-title'), 'words.txt is no picture');
      assert.equal(await page.textContent('#texture-picture'), 'a checker');
    }));
});

describe('a textured model', () => {
  const onTexture = sharedModel(site, BOX, { unfolded: ['texture-block'] }, (page) => makeTexture(page));

  test('is saved as binary glTF: in metres, y up, its picture inside', () =>
    onTexture(async (page) => {
      const { name, bytes } = await saved(page, '#texture-download');
      assert.equal(name, 'box-textured.glb');
      const gltf = gltfOf(bytes);
      const { attributes } = gltf.meshes[0].primitives[0];
      const position = gltf.accessors[attributes.POSITION];
      assert.equal(position.count, 36);
      assert.deepEqual([...position.min, ...position.max], [-20, -15, -10, 20, 15, 10]);
      assert.deepEqual(gltf.nodes[0].scale, [0.001, 0.001, 0.001]);
      assert.deepEqual(gltf.nodes[0].translation.map((value) => Number(value.toPrecision(6))), [0.02, 0.01, -0.015]);
      const place = gltf.accessors[attributes.TEXCOORD_0];
      assert.equal(place.type, 'VEC2');
      assert.equal(place.count, 36);
      assert.equal(gltf.images[0].mimeType, 'image/png');
      const { byteOffset, byteLength } = gltf.bufferViews[gltf.images[0].bufferView];
      const start = 20 + bytes.readUInt32LE(12) + 8 + (byteOffset ?? 0);
      assert.equal(bytes.subarray(start, start + byteLength).subarray(1, 4).toString('latin1'), 'PNG');
      assert.equal(gltf.materials[0].pbrMetallicRoughness.baseColorTexture.index, 0);
    }));

  test('is saved as OBJ with its material and its picture, by the names that they have for each other', () =>
    onTexture(async (page) => {
      await page.selectOption('#texture-download-format', 'zip');
      const { name, bytes } = await saved(page, '#texture-download');
      assert.equal(name, 'box-textured.zip');
      const files = unzipSync(bytes);
      assert.deepEqual(Object.keys(files).sort(), ['box-textured.mtl', 'box-textured.obj', 'box-textured.png']);
      const text = (file) => Buffer.from(files[file]).toString();
      assert.match(text('box-textured.obj'), /^mtllib box-textured\.mtl$/m);
      assert.equal(text('box-textured.obj').match(/^f \d+\/\d+ \d+\/\d+ \d+\/\d+$/gm).length, 12);
      const places = text('box-textured.obj').match(/^vt .*$/gm).flatMap((line) => line.split(' ').slice(1).map(Number));
      assert.ok(places.every(Number.isFinite));
      assert.match(text('box-textured.mtl'), /^map_Kd box-textured\.png$/m);
      // The same places as in glTF, where v goes downward.
      await page.selectOption('#texture-download-format', 'glb');
      const glb = (await saved(page, '#texture-download')).bytes;
      const corners = [...text('box-textured.obj').matchAll(/ \d+\/(\d+)/g)].map(([, place]) => Number(place) - 1);
      coordinatesOf(glb).forEach(([u, v], k) => {
        const [x, y] = [places[2 * corners[k]], places[2 * corners[k] + 1]];
        assert.ok(Math.abs(u - x) < 1e-6 && Math.abs(1 - v - y) < 1e-6, `corner ${k}: ${u}, ${v} for ${x}, ${y}`);
      });
    }));

  test('fits a narrow page', () =>
    withTexture(
      async (page) => {
        await page.click('#seam-draw:enabled');
        assert.deepEqual(await outside(page), []);
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
      },
      { width: 390, height: 844 },
    ));
});
