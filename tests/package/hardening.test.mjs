// What a page does to an engine that nobody wishes for: threads that panic, trap or are ended, memory that runs out, pages that are
// hidden or frozen, many loads and aborts, and two copies of the package.
import assert from 'node:assert/strict';
import { fileURLToPath } from 'node:url';
import { after, before, test } from 'node:test';
import { launch } from '../page/browser.mjs';
import { install, installFaulty } from './install.mjs';
import { FOR_ALL, ISOLATED, inPage as evaluate, serve } from './pages.mjs';

const files = Object.fromEntries(
  ['watched.js', 'watched-worker.js'].map((name) => [`/${name}`, fileURLToPath(new URL(name, import.meta.url))]),
);
const homes = { sound: install().home, faulty: installFaulty().home };

let chromium;
const servers = {};
before(async () => {
  chromium = await launch();
  servers.isolated = await serve(homes.sound, { ...ISOLATED, ...FOR_ALL }, files);
  servers.plain = await serve(homes.sound, FOR_ALL, files);
  servers.faulty = await serve(homes.faulty, { ...ISOLATED, ...FOR_ALL });
});
after(async () => {
  await chromium.close();
  Object.values(servers).forEach((server) => server.close());
});

/** What the pages share: put before each action. */
const tools = () => {
  /** Keeps hold of the engine's worker, which the page never sees otherwise. */
  globalThis.workers = [];
  globalThis.Worker = class extends Worker {
    constructor(...args) {
      super(...args);
      workers.push(this);
    }
  };
  globalThis.tetrahedron = () => ({
    positions: new Float64Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]),
    indices: new Uint32Array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]),
  });
  /** Triangles without any order, for calls that take a while. */
  globalThis.loose = (count) => ({ positions: new Float64Array(9 * count).map((_, i) => 10 * ((i * 0.618034) % 1)) });
  globalThis.inside = async (fw) => [...(await (await fw.Soup.from(tetrahedron())).contains(new Float64Array([0.2, 0.2, 0.2, 1, 1, 1])))];
  globalThis.outcome = (promise) => promise.then(() => 'done', ({ code }) => code);
  globalThis.memoryOf = (worker) =>
    new Promise((resolve) => {
      const { port1, port2 } = new MessageChannel();
      port1.onmessage = ({ data }) => resolve(data);
      worker.postMessage({ type: 'memory', port: port2 }, [port2]);
    });
};

const inPage = (server, action, ...args) =>
  evaluate(chromium, server, server.origin, 'index.js', `(module) => ((${tools})(), (${action})(module, ...${JSON.stringify(args)}))`);

for (const how of ['panic', 'trap']) {
  test(`after a ${how} in a thread of the pool the page's call rejects, and the page goes on`, async () => {
    const fault = async ({ init }, how) => {
      const fw = await init({ threads: 2 });
      const soup = await fw.Soup.from(tetrahedron());
      const codes = await Promise.all([soup.ask('fault', [how, 'pool']), soup.prepare()].map(outcome));
      const next = await init({ threads: 2 });
      return { codes, isSame: next === fw, inside: await inside(next) };
    };
    const found = await inPage(servers.faulty, fault, how);
    const isFatal = how === 'trap';
    assert.deepEqual(found, { codes: ['Crashed', isFatal ? 'Crashed' : 'done'], isSame: !isFatal, inside: [1, 0] });
  });
}

test('when the engine is ended in mid-call, every call rejects, and init starts anew', async () => {
  const end = async ({ init }) => {
    const fw = await init({ threads: 2 });
    const soup = await fw.Soup.from(loose(20000));
    const running = soup.voxelize({ resolution: 300 });
    const waiting = soup.contains(new Float64Array(3));
    setTimeout(() => workers[0].terminate(), 200);
    const codes = await Promise.all([running, waiting].map(outcome));
    const next = await init({ threads: 2 });
    return { codes, isSame: next === fw, inside: await inside(next) };
  };
  const found = await inPage(servers.isolated, end);
  assert.deepEqual(found, { codes: ['Crashed', 'Crashed'], isSame: false, inside: [1, 0] });
});

test('when a thread of the pool is ended, calls reject rather than wait for it, and init starts anew', async () => {
  const end = async ({ init }) => {
    const options = { threads: 2, workerUrl: '/watched.js' };
    const fw = await init(options);
    const soup = await fw.Soup.from(tetrahedron());
    workers[0].postMessage({ type: 'end-thread', thread: 1 });
    let code = 'done';
    // A browser takes some seconds to end a thread that never looks up.
    for (let i = 0; i < 200 && code === 'done'; i++) {
      code = await outcome(soup.voxelize({ resolution: 40 }));
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    const next = await init(options);
    return { code, isSame: next === fw, inside: await inside(next) };
  };
  assert.deepEqual(await inPage(servers.isolated, end), { code: 'Crashed', isSame: false, inside: [1, 0] });
});

test('a single-threaded engine that is ended rejects its calls too', async () => {
  const end = async ({ init }) => {
    const fw = await init({ threads: 0 });
    const soup = await fw.Soup.from(loose(20000));
    const running = soup.voxelize({ resolution: 300 });
    setTimeout(() => workers[0].terminate(), 200);
    const code = await outcome(running);
    return { code, inside: await inside(await init({ threads: 0 })) };
  };
  assert.deepEqual(await inPage(servers.plain, end), { code: 'Crashed', inside: [1, 0] });
});

test('where memory is short, what does not fit fails with a code, and the rest goes on', async () => {
  const fill = async ({ init }) => {
    const options = { threads: 2, workerUrl: '/watched.js?pages=500' };
    const fw = await init(options);
    const soup = await fw.Soup.from(tetrahedron());
    const asked = await soup.voxelize({ resolution: 1000 }).catch(({ code, details }) => ({ code, bytes: details.bytes }));
    const after = [...(await soup.contains(new Float64Array([0.2, 0.2, 0.2])))];
    const many = await outcome(fw.Soup.from(loose(1_000_000)));
    const again = await init(options);
    return { asked, after, many, inside: await inside(again), threads: again.info.threads };
  };
  const { many, ...found } = await inPage(servers.isolated, fill);
  assert.deepEqual(found, { asked: { code: 'OutOfMemory', bytes: 125_000_000 }, after: [1], inside: [1, 0], threads: 2 });
  assert.ok(['OutOfMemory', 'Crashed'].includes(many), many);
});

test('a page that is hidden or frozen during a call gets its answer', async () => {
  const page = await chromium.newPage();
  try {
    await page.goto(`${servers.isolated.origin}/`);
    await page.evaluate(`(${tools})()`);
    const begin = async () => {
      const { init } = await import('/dist/index.js');
      const soup = await (await init()).Soup.from(loose(3000));
      globalThis.call = soup.voxelize({ resolution: 40 });
    };
    await page.evaluate(begin);
    const other = await chromium.newPage();
    await other.bringToFront();
    const session = await page.context().newCDPSession(page);
    await session.send('Page.setWebLifecycleState', { state: 'frozen' });
    await new Promise((resolve) => setTimeout(resolve, 500));
    await session.send('Page.setWebLifecycleState', { state: 'active' });
    assert.deepEqual(await page.evaluate(() => call.then(({ counts }) => counts)), [40, 40, 40]);
    await other.close();
  } finally {
    await page.close();
  }
});

for (const [name, threads] of [['isolated', 2], ['plain', 0]]) {
  test(`a hundred loads take no more memory than ten (${name})`, async () => {
    const load = async ({ init }, threads) => {
      const fw = await init({ threads, workerUrl: '/watched.js' });
      const text = Array.from({ length: 3000 }, (_, i) => `v ${i % 50} ${(i * 7) % 90} ${(i * 13) % 70}\nf -1 ${1 + (i % 9)} ${1 + (i % 7)}\n`);
      const bytes = new TextEncoder().encode(`v 0 0 0\n${text.join('')}`);
      const sizes = [];
      for (let i = 0; i < 100; i++) {
        const soup = await fw.open(bytes);
        await soup.contains(new Float64Array(300).map((_, k) => k % 50));
        await soup.voxelize({ resolution: 20 });
        soup.free();
        if (i === 9 || i === 99) sizes.push(await memoryOf(workers[0]));
      }
      return { sizes, kept: fw.info.memory, threads: fw.info.threads };
    };
    const { sizes, ...found } = await inPage(servers[name], load, threads);
    assert.deepEqual(found, { kept: 0, threads });
    assert.equal(sizes[1], sizes[0]);
  });

  test(`calls aborted at fifty random moments are answered or aborted, and nothing else (${name})`, async () => {
    const abort = async ({ init }, threads) => {
      const fw = await init({ threads });
      const soup = await fw.Soup.from(loose(1000));
      const options = { resolution: 40 };
      const start = performance.now();
      const expected = (await soup.voxelize(options)).count;
      const duration = performance.now() - start;
      let state = 1;
      const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
      const outcomes = {};
      for (let i = 0; i < 50; i++) {
        const controller = new AbortController();
        const call = soup.voxelize({ ...options, signal: controller.signal });
        const moment = random() * 1.5 * duration;
        setTimeout(() => controller.abort(), moment);
        const found = await call.then(({ count }) => (count === expected ? 'right' : 'wrong'), ({ code }) => code);
        outcomes[found] = (outcomes[found] ?? 0) + 1;
      }
      return { outcomes, inside: await inside(fw), count: (await soup.voxelize(options)).count === expected };
    };
    const { outcomes, ...found } = await inPage(servers[name], abort, threads);
    assert.deepEqual(found, { inside: [1, 0], count: true });
    assert.deepEqual(Object.keys(outcomes).filter((key) => !['Aborted', 'right'].includes(key)), []);
    assert.ok(outcomes.Aborted > 0, JSON.stringify(outcomes));
  });
}

test('two copies of the package on a page have an engine each, and one outlives the other', async () => {
  const both = async ({ init }, other) => {
    const second = await import(`${other}/dist/index.js`);
    const [fw, its] = await Promise.all([init({ threads: 2 }), second.init({ threads: 2 })]);
    const soup = await fw.Soup.from(tetrahedron());
    const answers = await Promise.all([inside(fw), inside(its)]);
    const code = await outcome(soup.ask('fault', ['trap', 'pool']));
    return { isSame: init === second.init || fw === its, answers, code, its: await inside(its), anew: await inside(await init({ threads: 2 })) };
  };
  const found = await inPage(servers.faulty, both, servers.plain.origin);
  assert.deepEqual(found, { isSame: false, answers: [[1, 0], [1, 0]], code: 'Crashed', its: [1, 0], anew: [1, 0] });
});
