// The package in a plain page, without a bundler: with and without cross-origin isolation, and from another origin.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { launch } from '../page/browser.mjs';
import { install } from './install.mjs';
import { testOrigins } from './origins.mjs';
import { FOR_ALL, ISOLATED, answers, ask, inPage as evaluate, serve } from './pages.mjs';

const { home } = install();
/** What the package's README says it needs, and nothing else. */
const POLICY = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; connect-src 'self'";

let chromium;
const servers = {};
before(async () => {
  chromium = await launch();
  servers.isolated = await serve(home, { ...ISOLATED, ...FOR_ALL });
  servers.plain = await serve(home, FOR_ALL);
  servers.strict = await serve(home, { ...ISOLATED, 'Content-Security-Policy': POLICY });
});
after(async () => {
  await chromium.close();
  Object.values(servers).forEach((server) => server.close());
});

const inPage = (server, origin, file, action) => evaluate(chromium, server, origin, file, action);

testOrigins(servers, inPage);

test('worker and WebAssembly may lie elsewhere than the script', async () => {
  const { origin } = servers.plain;
  const options = { workerUrl: `${origin}/dist/worker.js`, wasmUrl: `${origin}/dist/` };
  const asked = `(module) => (${ask})(module, ${JSON.stringify(options)})`;
  for (const [server, isIsolated] of [[servers.isolated, true], [servers.plain, false]]) {
    const { threads, reason, ...rest } = await inPage(server, server.origin, 'index.js', asked);
    assert.deepEqual([rest, threads > 0], [{ ...answers, isolated: isIsolated }, isIsolated], reason);
  }
});

test('a strict policy for content is enough, with threads', async () => {
  const { threads, reason, ...rest } = await inPage(servers.strict, servers.strict.origin, 'index.js', ask);
  assert.deepEqual(rest, { ...answers, isolated: true });
  assert.ok(threads >= 1, reason);
});

test('an abort takes effect in both builds, and the page stays responsive meanwhile', async () => {
  const abort = async ({ init }) => {
    const fw = await init();
    const positions = new Float64Array(90000).map((_, i) => 10 * ((i * 0.618034) % 1));
    const soup = await fw.Soup.from({ positions });
    const controller = new AbortController();
    const call = soup.voxelize({ resolution: 400, signal: controller.signal });
    let [longest, last] = [0, performance.now()];
    for (let i = 0; i < 20; i++) {
      await new Promise((resolve) => setTimeout(resolve, 5));
      const now = performance.now();
      [longest, last] = [Math.max(longest, now - last), now];
    }
    controller.abort();
    const code = await call.catch((error) => error.code);
    return { code, longest, again: (await soup.contains(new Float64Array(3))).length };
  };
  for (const server of [servers.isolated, servers.plain]) {
    const { code, longest, again } = await inPage(server, server.origin, 'index.js', abort);
    assert.deepEqual([code, again], ['Aborted', 1]);
    assert.ok(longest < 200, `the page hung for ${longest} ms`);
  }
});
