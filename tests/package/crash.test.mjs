// Panics and traps, in the engine's own thread and in its pool: every call is answered, and `init` works again.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { installFaulty } from './install.mjs';
import { box } from './shapes.mjs';

const { load } = installFaulty();
const { init } = await load('node/index.js');
const center = new Float64Array([0.5, 0.5, 0.5]);

for (const place of ['caller', 'pool']) {
  test(`after a panic in the ${place} the engine goes on`, async () => {
    const fw = await init({ threads: 2 });
    const soup = await fw.Soup.from(box(0, 1));
    await assert.rejects(soup.ask('fault', ['panic', place]), { code: 'Crashed', message: /a panic on purpose/ });
    assert.deepEqual(await soup.contains(center), new Uint8Array([1]));
    assert.equal(await init({ threads: 2 }), fw);
    fw.dispose();
  });

  test(`after a trap in the ${place} every call rejects, and init starts anew`, async () => {
    const fw = await init({ threads: 2 });
    const soup = await fw.Soup.from(box(0, 1));
    const calls = [soup.ask('fault', ['trap', place]), soup.contains(center), soup.prepare()];
    for (const { status, reason } of await Promise.allSettled(calls)) {
      assert.deepEqual([status, reason?.code], ['rejected', 'Crashed']);
    }
    await assert.rejects(soup.contains(center), { code: 'Crashed', message: /call init again/ });
    const next = await init({ threads: 2 });
    assert.notEqual(next, fw);
    assert.deepEqual(await (await next.Soup.from(box(0, 1))).contains(center), new Uint8Array([1]));
    next.dispose();
  });
}
