// Runs targets of the fuzzer until each has used its minutes of processor time, and says what they found:
//   node fuzz/run.mjs [--minutes M] [--jobs N] [TARGET …]
// Minutes and executions add up in target/fuzzing/: what has had its minutes is not run again.
import { spawn } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { StepFailed, program, run } from '../pkg-config/tools/run.mjs';

const folder = import.meta.dirname;
/** What the targets find, and how long they ran: outside the corpus, which holds what the tests run. */
const work = join(folder, 'target/fuzzing');
const LIMITS = ['-timeout=60', '-rss_limit_mb=3000', '-max_len=4096', '-print_final_stats=1'];
/** Ticks of a processor in a second, as Linux counts them. */
const TICKS = 100;

const TARGETS = readdirSync(join(folder, 'fuzz_targets')).map((name) => name.replace('.rs', ''));

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: { minutes: { type: 'string', default: '10' }, jobs: { type: 'string', default: '1' } },
});

/** Seconds of processor time that a process has used; 0 once it is gone. */
function used(pid) {
  try {
    const fields = readFileSync(`/proc/${pid}/stat`, 'utf8').split(') ')[1].split(' ');
    return (Number(fields[11]) + Number(fields[12])) / TICKS;
  } catch {
    return 0;
  }
}

const file = (target) => join(work, `${target}.json`);
const soFar = (target) => (existsSync(file(target)) ? JSON.parse(readFileSync(file(target), 'utf8')) : { seconds: 0, executions: 0, edges: 0, crashes: 0 });

/** Runs one target until it has used `seconds` in all; resolves to what has come of it. */
function fuzz(target, seconds) {
  const before = soFar(target);
  if (before.seconds >= seconds) return before;
  const found = join(work, target);
  const artifacts = join(folder, 'artifacts', target);
  for (const path of [found, artifacts]) mkdirSync(path, { recursive: true });
  const args = [...LIMITS, `-artifact_prefix=${artifacts}/`, found, join(folder, 'corpus', target)];
  const binary = join(folder, 'target/x86_64-unknown-linux-gnu/release', target);
  return new Promise((resolve, reject) => {
    const child = spawn(binary, args, { env: { ...process.env, RAYON_NUM_THREADS: '1' }, stdio: ['ignore', 'ignore', 'pipe'] });
    let [tail, latest, last] = ['', before, 0];
    child.stderr.on('data', (chunk) => (tail = (tail + chunk).slice(-20000)));
    const note = () => {
      const most = (pattern, least) => Math.max(least, ...[...tail.matchAll(pattern)].map((match) => Number(match[1])));
      last = Math.max(last, used(child.pid));
      latest = { ...before, seconds: before.seconds + last, executions: before.executions + most(/^#(\d+)\t/gm, 0), edges: most(/ cov: (\d+)/g, before.edges) };
      writeFileSync(file(target), JSON.stringify(latest));
    };
    const timer = setInterval(() => {
      note();
      if (latest.seconds >= seconds) child.kill('SIGINT');
    }, 2000);
    child.on('error', reject);
    child.on('close', () => {
      clearInterval(timer);
      note();
      const crash = tail.match(/Test unit written to (.*)/)?.[1];
      if (crash) latest = { ...latest, crashes: latest.crashes + 1, crash };
      writeFileSync(file(target), JSON.stringify(latest));
      resolve(latest);
    });
  });
}

await program(async () => {
  const unknown = positionals.find((name) => !TARGETS.includes(name));
  if (unknown) throw new StepFailed(`there is no target ${unknown}; there are ${TARGETS.join(', ')}`);
  const waiting = positionals.length ? [...positionals] : [...TARGETS];
  const seconds = 60 * Number(values.minutes);
  const worker = async () => {
    for (let target = waiting.shift(); target; target = waiting.shift()) {
      const { seconds: s, executions, edges, crash } = await fuzz(target, seconds);
      console.log(`${target.padEnd(14)}${(s / 60).toFixed(1).padStart(6)} min${String(executions).padStart(11)} runs${String(edges).padStart(7)} edges${crash ? `  ✗ ${crash}` : ''}`);
    }
  };
  await Promise.all(Array.from({ length: Number(values.jobs) }, worker));
});
