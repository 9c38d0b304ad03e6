// What holds of the package in every browser: with and without cross-origin isolation, and from another origin.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { answers, ask } from './pages.mjs';

/**
 * Defines the tests. Of `servers`, which are there once these run, one is `isolated` and one `plain`, and both may be asked from
 * elsewhere; `inPage(server, origin, file, action)` runs `action(module)` in a page of `server` with a module of the package from `origin`.
 */
export function testOrigins(servers, inPage) {
  test('an isolated page gets threads', async () => {
    const { threads, reason, ...rest } = await inPage(servers.isolated, servers.isolated.origin, 'index.js', ask);
    assert.deepEqual(rest, { ...answers, isolated: true });
    assert.ok(threads >= 1);
    assert.match(reason, /threads: one for each processor/);
  });

  test('a page that is not isolated gets the single-threaded build and the reason', async () => {
    const { reason, ...rest } = await inPage(servers.plain, servers.plain.origin, 'index.js', ask);
    assert.deepEqual(rest, { ...answers, isolated: false, threads: 0 });
    assert.match(reason, /not cross-origin isolated/);
  });

  test('the package may come from another origin, threads included', async () => {
    const { threads, reason, ...rest } = await inPage(servers.isolated, servers.plain.origin, 'index.js', ask);
    assert.deepEqual(rest, { ...answers, isolated: true });
    assert.ok(threads >= 1, reason);
  });

  test('the synchronous entry works on the page itself', async () => {
    const { inside, centre, threads } = await inPage(servers.plain, servers.plain.origin, 'sync.js', ask);
    assert.deepEqual([inside, centre, threads], [[1, 0], '1.00', 0]);
  });
}
