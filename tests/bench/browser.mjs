// Measures the package in headless Chromium beside three-mesh-bvh's test by a ray: is each of 100³ samples inside?
// Run by `npm --prefix www run bench browser [-- --quick]`; prints medians and ratios.
import { execFileSync } from 'node:child_process';
import { createReadStream, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { cache } from '../../pkg-config/tools/paths.mjs';
import { launch } from '../page/browser.mjs';
import { markdown, measuringProgram, milliseconds, modelsFolder } from './measuring.mjs';
import { model, randomOf } from './models.mjs';

const root = fileURLToPath(new URL('../../', import.meta.url));
const isQuick = process.argv.includes('--quick');
const COUNT = isQuick ? 24 : 100;
/** The peer is no dependency of the project: it lies in the user's cache. */
const PEER = { name: 'three-mesh-bvh', version: '0.9.17', folder: join(cache, 'browser-peers') };
const MODELS = [
  { kind: 'closed', name: 'bumpy70k', goal: 100 },
  { kind: 'open', name: 'bunny', goal: 30 },
];
/** Samples that the direct sum judges: those where the contestants differ (at most so many), and as many at random. */
const JUDGED = isQuick ? 500 : 2000;
/** On |w - 1/2| below this nothing is right or wrong. */
const TIE = 1e-9;

const FOLDERS = {
  '/dist/': join(root, 'pkg/dist/'),
  '/bench/': join(root, 'tests/bench/'),
  '/models/': `${modelsFolder}/`,
  '/three/': join(root, 'www/node_modules/three/build/'),
  '/peer/': join(PEER.folder, 'node_modules', PEER.name, 'build/'),
};
const TYPES = { '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm' };
const ISOLATED = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };
const IMPORTS = { imports: { three: '/three/three.module.js', 'three-mesh-bvh': '/peer/index.module.js' } };
const PAGE = `<!doctype html><script type="importmap">${JSON.stringify(IMPORTS)}</script>`;

function installPeer() {
  const manifest = join(PEER.folder, 'node_modules', PEER.name, 'package.json');
  if (existsSync(manifest) && JSON.parse(readFileSync(manifest, 'utf8')).version === PEER.version) return;
  console.error(`installing ${PEER.name} ${PEER.version} into ${PEER.folder}`);
  mkdirSync(PEER.folder, { recursive: true });
  // Its peer dependency, three, comes from www/.
  const args = ['install', '--legacy-peer-deps', '--ignore-scripts', '--no-audit', '--no-fund', `${PEER.name}@${PEER.version}`];
  execFileSync('npm', args, { cwd: PEER.folder, stdio: ['ignore', 'ignore', 'inherit'] });
}

async function serve() {
  const server = createServer(({ url }, response) => {
    const path = new URL(url, 'http://here').pathname;
    if (path === '/') return response.writeHead(200, { ...ISOLATED, 'Content-Type': 'text/html' }).end(PAGE);
    const prefix = Object.keys(FOLDERS).find((start) => path.startsWith(start));
    const file = prefix && join(FOLDERS[prefix], path.slice(prefix.length));
    if (!file || !existsSync(file) || !statSync(file).isFile()) return response.writeHead(404, ISOLATED).end();
    response.writeHead(200, { ...ISOLATED, 'Content-Type': TYPES[extname(file)] ?? 'application/octet-stream' });
    return createReadStream(file).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { origin: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}

/** Calls a function of browser-page.mjs in a page of its own: nobody finds the other's code warm or memory full. */
async function inPage(chromium, origin, name, ...args) {
  const page = await chromium.newPage();
  try {
    await page.goto(`${origin}/`);
    return await page.evaluate(`import('/bench/browser-page.mjs').then((page) => page.${name}(...${JSON.stringify(args)}))`);
  } finally {
    await page.close();
  }
}

/** w by the direct sum at some samples of a lattice. */
function sumDirectly(program, path, samples, { origin, spacing }) {
  const folder = mkdtempSync(join(tmpdir(), 'fast-winding-bench-'));
  const cells = samples.flatMap((i) => [i % COUNT, Math.floor(i / COUNT) % COUNT, Math.floor(i / COUNT ** 2)]);
  writeFileSync(join(folder, 'points'), Float64Array.from(cells, (cell, i) => origin[i % 3] + spacing[i % 3] * cell));
  execFileSync(program, ['oracle', path, '--points', join(folder, 'points'), '--output', join(folder, 'values')]);
  const bytes = readFileSync(join(folder, 'values'));
  rmSync(folder, { recursive: true });
  return new Float64Array(bytes.buffer, bytes.byteOffset, samples.length);
}

/** How many of all samples each contestant has wrong, estimated from those judged, and how many were ties. */
function judge(program, path, lattice, answers) {
  const random = randomOf(3);
  const shuffled = (array) => {
    for (let i = array.length - 1; i > 0; i--) {
      const j = Math.floor(random() * (i + 1));
      [array[i], array[j]] = [array[j], array[i]];
    }
    return array;
  };
  const differing = [];
  const agreeing = [];
  for (let i = 0; i < COUNT ** 3; i++) (answers.every((a) => a[i] === answers[0][i]) ? agreeing : differing).push(i);
  const wrong = answers.map(() => 0);
  let ties = 0;
  const parts = [differing, agreeing].map((part) => ({ size: part.length, judged: shuffled(part).slice(0, JUDGED) }));
  for (const { size, judged } of parts.filter((part) => part.judged.length)) {
    const values = sumDirectly(program, path, judged, lattice);
    judged.forEach((sample, k) => {
      if (Math.abs(values[k] - 0.5) < TIE) return void ties++;
      const right = values[k] >= 0.5 ? '1' : '0';
      answers.forEach((answer, who) => (wrong[who] += answer[sample] === right ? 0 : size / judged.length));
    });
  }
  const sampled = differing.length > JUDGED ? ` (${JUDGED} of ${differing.length} differing judged)` : '';
  return { wrong: wrong.map(Math.round), ties, sampled };
}

async function measure(chromium, origin, program, { kind, name, goal }) {
  const path = model(modelsFolder, name);
  const url = `/models/${path.slice(modelsFolder.length + 1)}`;
  const threaded = await inPage(chromium, origin, 'ours', url, COUNT, 'auto');
  const single = await inPage(chromium, origin, 'ours', url, COUNT, false);
  const theirs = await inPage(chromium, origin, 'theirs', url, COUNT, threaded.origin, threaded.spacing);
  const { wrong, ties, sampled } = judge(program, path, threaded, [theirs.inside, threaded.inside, single.inside]);
  const nanoseconds = (time) => `${((1e6 * time) / COUNT ** 3).toPrecision(3)} ns`;
  return [threaded, single].map((ours, i) => {
    const ratio = theirs.included / ours.included;
    const missed = [ratio < goal && 'ratio', wrong[1 + i] > 0 && 'wrong'].filter(Boolean);
    return {
      model: `${kind}: ${name}`,
      samples: `${COUNT}³`,
      ours: ours.threads ? `${ours.threads} threads` : 'single-threaded',
      'their build + queries': milliseconds(theirs.included),
      'our build + queries': milliseconds(ours.included),
      ratio: `${ratio.toPrecision(3)} ×`,
      goal: `≥ ${goal} ×`,
      'a query, theirs / ours, built before': `${nanoseconds(theirs.excluded)} / ${nanoseconds(ours.excluded)}`,
      'ratio, built before': `${(theirs.excluded / ours.excluded).toPrecision(3)} ×`,
      'wrong theirs / ours': `${wrong[0]} / ${wrong[1 + i]}${sampled}`,
      'skipped ties': ties,
      met: missed.length ? `**no**: ${missed.join(', ')}` : 'yes',
    };
  });
}

installPeer();
const program = measuringProgram();
const [server, chromium] = [await serve(), await launch()];
try {
  const rows = [];
  for (const each of MODELS) rows.push(...(await measure(chromium, server.origin, program, each)));
  console.log(`\nChromium ${chromium.version()}, ${PEER.name} ${PEER.version}\n\n${markdown(rows)}`);
} finally {
  await chromium.close();
  server.close();
}
