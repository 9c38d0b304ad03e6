// The package and the page in Firefox: with threads and without, the same bits as in Node, and tools of the page once.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { install } from '../package/install.mjs';
import { testOrigins } from '../package/origins.mjs';
import { FOR_ALL, ISOLATED, serve } from '../package/pages.mjs';
import { serve as servePage } from '../page/serve.mjs';
import { visitor } from './visits.mjs';

const { home, load } = install();
const { init } = await load('node/index.js');

let firefox;
const files = {};
const servers = {};
const folder = mkdtempSync(join(tmpdir(), 'fast-winding-'));
before(async () => {
  firefox = await visitor(process.env.FIREFOX);
  servers.isolated = await serve(home, { ...ISOLATED, ...FOR_ALL }, files);
  servers.plain = await serve(home, FOR_ALL, files);
});
after(async () => {
  await firefox?.close();
  Object.values(servers).forEach((server) => server.close());
  rmSync(folder, { recursive: true, force: true });
});

/** Runs `action(module)` in a page of `server` with a module of the package, which comes from `origin`. */
function inPage(server, origin, file, action) {
  const path = `/visits/${Object.keys(files).length}.html`;
  files[path] = join(folder, path.replaceAll('/', '-'));
  const script = firefox.telling(`import(${JSON.stringify(`${origin}/dist/${file}`)}).then(${action})`);
  writeFileSync(files[path], `<!doctype html><script type="module">${script}</script>`);
  return firefox.visit(server.origin + path);
}

testOrigins(servers, inPage);

/** Numbers of many capabilities, of a torus with a hole; run in the page and in Node. */
async function numbers({ init }, options) {
  const fw = await init(options);
  const [n, positions] = [40, []];
  const at = (i, j) => {
    const [u, v] = [(i / n) * 2 * Math.PI, (j / n) * 2 * Math.PI];
    // Sines are not the same in all engines.
    return [(3 + Math.cos(v)) * Math.cos(u), (3 + Math.cos(v)) * Math.sin(u), Math.sin(v)].map((x) => Math.round(x * 1e6) / 1e6);
  };
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < n - (i < 4 ? 6 : 0); j++) {
      const [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
      positions.push(...a, ...b, ...c, ...a, ...c, ...d);
    }
  }
  const soup = await fw.Soup.from({ positions: new Float64Array(positions) });
  const queries = new Float64Array(900).map((_, i) => ((i * 0.618034) % 1) * 8 - 4);
  const layers = await soup.slice({ layerHeight: 0.2 });
  const mesh = await soup.surface({ resolution: 32 });
  const repaired = await (await soup.repair({ check: false })).soup.geometry();
  const cloud = await fw.Cloud.from({ points: mesh.positions, normals: mesh.normals });
  return [
    await soup.windingNumbers(queries),
    await soup.signedDistance(queries),
    (await soup.voxelize({ resolution: 40 })).inside,
    layers.flatMap((layer) => layer.polygons.flatMap(({ outer, holes }) => [outer, ...holes].map((ring) => [...ring]))).flat(),
    mesh.positions,
    repaired.positions,
    await cloud.windingNumbers(queries),
    // JSON knows no −0.
  ].map((values) => Array.from(values, (x) => x + 0));
}

test('all numbers are those of Node, to the last bit', async () => {
  const expected = await numbers({ init }, { threads: 2 });
  assert.ok(expected.every((values) => values.length > 100));
  for (const server of [servers.isolated, servers.plain]) {
    const found = await inPage(server, server.origin, 'index.js', numbers);
    found.forEach((values, k) => assert.deepEqual(values, expected[k], `the ${k}th of the results`));
  }
});

/** Uses tools of the page, as somebody does who presses their buttons, and tells what it says; run in the page. */
async function useTools() {
  const errors = [];
  addEventListener('error', ({ message }) => errors.push(message));
  addEventListener('unhandledrejection', ({ reason }) => errors.push(String(reason)));
  const until = async (holds) => {
    while (!holds()) await new Promise((resolve) => setTimeout(resolve, 50));
  };
  const find = (selector) => document.querySelector(selector);
  await until(() => find('#layer-download:enabled'));
  const made = () => document.querySelectorAll('#results input').length;
  for (const tool of ['#repair', '#voxelize', '#surface', '#offset']) {
    await until(() => find(`${tool}:enabled`));
    const before = made();
    find(tool).click();
    await until(() => made() > before && find('#job').hidden);
  }
  find('#check').click();
  await until(() => find('#check-facts dd') && find('#job').hidden);
  return { results: made(), problem: find('#problem').hidden ? '' : find('#problem').textContent, engine: find('#engine-text').textContent, errors };
}

test('the page works on a host that sets no headers: its service worker gives it threads', async () => {
  // Before the worker is there the page is loaded once, and leaves before it tells anything.
  const script = `<script type="module">if (crossOriginIsolated) ${firefox.telling(`(${useTools})()`)}</script>`;
  const server = await servePage({
    isolated: false,
    edit: (path, file) => (path === '/index.html' ? readFileSync(file, 'utf8').replace('</body>', `${script}</body>`) : undefined),
  });
  try {
    const { engine, ...rest } = await firefox.visit(`${server.url}#sample=teapot`);
    assert.deepEqual(rest, { results: 5, problem: '', errors: [] });
    assert.match(engine, /threads?, SIMD/);
  } finally {
    await server.close();
  }
});
