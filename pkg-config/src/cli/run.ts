// The command line from the words that were typed to the exit code.
import { readFileSync } from 'node:fs';
import { type Plan, understand } from './arguments.js';
import { destinations } from './destination.js';
import { writeOut } from './files.js';
import { help, helpOf } from './help.js';
import { type Run, runJob } from './job.js';
import { runAll, share } from './jobs.js';
import { Progress } from './progress.js';
import { Reporter, type Result } from './report.js';
import { Stop } from './stop.js';
import { EXIT, UsageError } from './usage.js';

/** The exit code that one result asks for. */
function codeOf(result: Result): number {
  if ('error' in result) return EXIT.failed;
  return result.outcome.passes === false ? EXIT.doesNotPrint : EXIT.done;
}

/** Of several: what failed weighs more than what does not print. */
const weightiest = (codes: ReadonlySet<number>): number => [EXIT.failed, EXIT.doesNotPrint].find((code) => codes.has(code)) ?? EXIT.done;

async function runPlan(plan: Plan): Promise<number> {
  const { command, files, common } = plan;
  const jobs = command.files === 'each' ? files.map((file) => [file]) : [files];
  const places = destinations(plan, jobs.map(([first]) => first!));
  const stop = new Stop();
  const isShown = process.stderr.isTTY === true && !common.quiet;
  const run: Run = { plan, progress: new Progress(jobs.length, isShown), signal: stop.signal };
  const reporter = new Reporter(plan, run.progress);
  const codes = new Set<number>();
  await runAll(jobs.length, share(jobs.length, common.threads, common.jobs), stop.signal, async (index, engine) => {
    const result = await runJob(run, jobs[index]!, places[index], engine);
    codes.add(codeOf(result));
    // Of what was stopped there is nothing to tell.
    if (!stop.signal.aborted) await reporter.take(index, result).catch(() => {});
  });
  run.progress.clear();
  return stop.codeOr(weightiest(codes));
}

const version = (): string => JSON.parse(readFileSync(new URL('../../package.json', import.meta.url), 'utf8')).version;

/** Does what was typed; the exit code. */
export async function main(argv: readonly string[]): Promise<number> {
  try {
    const wish = understand(argv);
    if ('plan' in wish) return await runPlan(wish.plan);
    await writeOut('version' in wish ? `${version()}\n` : wish.help ? helpOf(wish.help) : help());
    return EXIT.done;
  } catch (error) {
    if (!(error instanceof UsageError)) throw error;
    const more = error.command ? `fast-winding ${error.command} --help` : 'fast-winding --help';
    process.stderr.write(`fast-winding: ${error.message}\nSee ${more}\n`);
    return EXIT.usage;
  }
}
