// Pages that a browser visits one after the other, and that tell what they found: nothing steers the browser, as that may hold up its workers.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

/** Nothing of Firefox's own comes between. */
const PREFERENCES = {
  'app.update.enabled': false,
  'browser.shell.checkDefaultBrowser': false,
  'browser.startup.homepage_override.mstone': 'ignore',
  'datareporting.policy.dataSubmissionEnabled': false,
  'toolkit.startup.max_resumed_crashes': -1,
};

/** Longest that a page may take. */
const PATIENCE = 120_000;

/** Starts Firefox, headless, with a profile of its own. */
export async function visitor(firefox) {
  const folder = mkdtempSync(join(tmpdir(), 'fast-winding-'));
  const lines = Object.entries(PREFERENCES).map(([name, value]) => `user_pref(${JSON.stringify(name)}, ${JSON.stringify(value)});\n`);
  writeFileSync(join(folder, 'user.js'), lines.join(''));
  let waiting;
  let next;
  const reports = [];
  const leave = () => {
    if (!waiting || !next) return;
    waiting.writeHead(302, { Location: next, 'Cache-Control': 'no-store' }).end();
    waiting = next = undefined;
  };
  const control = createServer(async (request, response) => {
    const { pathname } = new URL(request.url, 'http://here');
    if (pathname === '/go') {
      waiting = response;
      return leave();
    }
    const told = [];
    for await (const chunk of request) told.push(chunk);
    response.writeHead(200, { 'Access-Control-Allow-Origin': '*' }).end();
    if (pathname.startsWith('/report/')) reports[pathname.slice('/report/'.length)]?.(JSON.parse(Buffer.concat(told)));
  });
  await new Promise((resolve) => control.listen(0, '127.0.0.1', resolve));
  const origin = `http://127.0.0.1:${control.address().port}`;
  const env = { ...process.env, HOME: folder, MOZ_CRASHREPORTER_DISABLE: '1' };
  const browser = spawn(firefox, ['--headless', '--no-remote', '--profile', folder, `${origin}/go`], { stdio: 'ignore', env });
  return {
    /** Script text that tells the promise `action`, and lets the browser go on, for the visit that is next. */
    telling(action) {
      const to = `${origin}/report/${reports.length}`;
      const tell = `(told) => fetch(${JSON.stringify(to)}, { method: 'POST', body: JSON.stringify(told) }).then(() => location.replace(${JSON.stringify(`${origin}/go`)}))`;
      return `Promise.resolve().then(() => ${action}).then((value) => ({ value }), (error) => ({ error: String(error) })).then(${tell});`;
    },
    /** Resolves to what the page at `url` tells. */
    visit(url) {
      return new Promise((resolve, reject) => {
        const timer = setTimeout(() => reject(new Error(`${url} told nothing within ${PATIENCE / 1000} s`)), PATIENCE);
        reports.push(({ value, error }) => {
          clearTimeout(timer);
          if (error === undefined) resolve(value);
          else reject(new Error(error));
        });
        next = url;
        leave();
      });
    },
    async close() {
      const ended = new Promise((resolve) => browser.once('exit', resolve));
      browser.kill();
      await ended;
      control.closeAllConnections();
      control.close();
      rmSync(folder, { recursive: true, force: true });
    },
  };
}
