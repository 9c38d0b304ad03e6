// The package in pages of Chromium: folders that are served, and a question whose answer is known.
import { createReadStream, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';

const TYPES = { '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html' };
export const ISOLATED = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };
export const FOR_ALL = { 'Access-Control-Allow-Origin': '*', 'Cross-Origin-Resource-Policy': 'cross-origin' };

/** Serves a folder's files, others by their path, and an empty page at /. */
export async function serve(folder, headers, files = {}) {
  const server = createServer(({ url }, response) => {
    const path = new URL(url, 'http://here').pathname;
    const file = files[path] ?? join(folder, path);
    if (path === '/') return response.writeHead(200, { ...headers, 'Content-Type': 'text/html' }).end('<!doctype html>');
    if (!statSync(file, { throwIfNoEntry: false })?.isFile()) return response.writeHead(404, headers).end();
    response.writeHead(200, { ...headers, 'Content-Type': TYPES[extname(file)] ?? 'text/plain' });
    return createReadStream(file).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { origin: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}

/** Runs `action(module)` in a page of `server` with a module of the package, which comes from `origin`. */
export async function inPage(chromium, server, origin, file, action) {
  const page = await chromium.newPage();
  try {
    await page.goto(`${server.origin}/`);
    return await page.evaluate(`import(${JSON.stringify(`${origin}/dist/${file}`)}).then(${action})`);
  } finally {
    await page.close();
  }
}

/** A tetrahedron asked twice, and a cloud without normals, for which more is loaded; run in the page. */
export const ask = async ({ init }, options) => {
  const fw = await init(options);
  const soup = await fw.Soup.from({
    positions: new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]),
    indices: new Uint32Array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]),
  });
  const inside = [...(await soup.contains(new Float64Array([0.2, 0.2, 0.2, 1, 1, 1])))];
  const { counts } = await soup.voxelize({ resolution: 3 });
  const onSphere = (i, z = (2 * i + 1) / 3000 - 1, r = Math.sqrt(1 - z * z)) => [r * Math.cos(2.4 * i), r * Math.sin(2.4 * i), z];
  const cloud = await fw.Cloud.from({ points: new Float64Array(Array.from({ length: 3000 }, (_, i) => onSphere(i)).flat()) });
  await cloud.orient();
  const centre = (await cloud.windingNumbers(new Float64Array(3)))[0].toFixed(2);
  return { inside, counts, centre, threads: fw.info.threads, reason: fw.info.reason, isolated: self.crossOriginIsolated };
};
export const answers = { inside: [1, 0], counts: [3, 3, 3], centre: '1.00' };
