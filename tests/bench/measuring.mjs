// What the benches in Node and in the browser share.
import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('../../', import.meta.url));
const target = process.env.CARGO_TARGET_DIR || join(root, 'target');

/** Where models.mjs writes the models: the same for all benches. */
export const modelsFolder = join(target, 'bench-models');

/** Most runs of a job, and milliseconds after which no further one begins. */
const [REPEATS, ENOUGH] = [7, 3000];

/** Path of tests/bench/measure.rs, built for release. */
export function measuringProgram() {
  execFileSync('cargo', ['build', '--release', '--quiet', '--example', 'measure'], { cwd: root, stdio: 'inherit' });
  return join(target, 'release/examples/measure');
}

export const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

/** Median of what `run` answers, after one run that does not count: the engine's code is compiled as it runs. */
export async function repeat(run) {
  const start = performance.now();
  const times = [await run()];
  while (times.length <= REPEATS && performance.now() - start < ENOUGH) times.push(await run());
  return median(times.length > 1 ? times.slice(1) : times);
}

export const milliseconds = (value) => (value < 1000 ? `${value.toPrecision(3)} ms` : `${(value / 1000).toPrecision(3)} s`);

/** Rows with the same keys as a Markdown table. */
export function markdown(rows) {
  const heads = Object.keys(rows[0]);
  const line = (cells) => `| ${cells.join(' | ')} |`;
  return [line(heads), line(heads.map(() => '---')), ...rows.map((row) => line(Object.values(row)))].join('\n');
}
