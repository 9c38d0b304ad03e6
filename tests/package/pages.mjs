// Pages without a bundler that load the package: servers of its files, and pages that run what a test hands them.
import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';

const TYPES = { '.js': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html' };
const ISOLATED = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };
const FOR_ALL = { 'Access-Control-Allow-Origin': '*', 'Cross-Origin-Resource-Policy': 'cross-origin' };

/** Serves the package's files from `home`, others by their path, and an empty page at /: one that may have threads if `isolated`. */
export async function serve(home, { isolated, files = {} }) {
  const headers = { ...(isolated ? ISOLATED : {}), ...FOR_ALL };
  const server = createServer(({ url }, response) => {
    const path = new URL(url, 'http://here').pathname;
    const file = files[path] ?? join(home, path);
    if (path === '/') return response.writeHead(200, { ...headers, 'Content-Type': 'text/html' }).end('<!doctype html>');
    if (!existsSync(file) || !statSync(file).isFile()) return response.writeHead(404, headers).end();
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
