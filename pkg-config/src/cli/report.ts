// What is told of each input: lines for people or JSON for programs, in the order of the inputs whatever was done first.
import type { Plan } from './arguments.js';
import type { Outcome } from './command.js';
import { writeOut } from './files.js';
import type { Progress } from './progress.js';
import { toJson, warningRows } from './words.js';

/** What came of one job. */
export type Result = Success | Failure;
interface Success {
  names: readonly string[];
  outcome: Outcome;
  warnings: readonly { message: string }[];
  written: readonly string[];
}
interface Failure {
  names: readonly string[];
  error: { code: string; message: string; details: object };
}

function linesOf({ command, common }: Plan, { names, ...result }: Success): string {
  const { headline, rows = [] } = result.outcome;
  const written: [string, string][] = result.written.length > 3
    ? [['written', `${result.written[0]} … ${result.written.at(-1)}, ${result.written.length} files`]]
    : result.written.map((path) => ['written', path]);
  if (common.output === undefined && command.formats.length > 0 && command.name !== 'check') written.push(['written', 'nothing: -o FILE says where to']);
  const all = [...rows, ...warningRows(result.warnings), ...written];
  const width = Math.max(0, ...all.map(([name]) => name.length)) + 2;
  return [`${names.join(', ')}: ${headline}`, ...all.map(([name, value]) => `  ${name.padEnd(width)}${value}`)].join('\n');
}

function jsonOf({ command }: Plan, { names, ...result }: Result): string {
  const which = command.files === 'each' ? { file: names[0] } : { files: names };
  const begin = { command: command.name, ...which };
  if ('error' in result) return toJson({ ...begin, ok: false, error: result.error });
  const { report } = result.outcome;
  const own = (report as { warnings?: unknown[] }).warnings ?? [];
  return toJson({ ...begin, ok: true, ...report, warnings: [...result.warnings, ...own], written: result.written });
}

export class Reporter {
  private readonly waiting = new Map<number, Result>();
  private next = 0;
  private last: Promise<void> = Promise.resolve();

  constructor(
    private readonly plan: Plan,
    private readonly progress: Progress,
  ) {}

  /** Takes the result of job `index`, and tells all that is not behind one which is still going on. */
  take(index: number, result: Result): Promise<void> {
    this.waiting.set(index, result);
    for (let ready; (ready = this.waiting.get(this.next)); this.next++) {
      this.waiting.delete(this.next);
      const told = ready;
      this.last = this.last.then(() => this.tell(told));
    }
    return this.last;
  }

  private async tell(result: Result): Promise<void> {
    this.progress.clear();
    const { common } = this.plan;
    if ('error' in result) {
      process.stderr.write(`fast-winding: ${result.names.join(', ')}: ${result.error.code}: ${result.error.message}\n`);
    }
    if (common.json) return writeOut(`${jsonOf(this.plan, result)}\n`);
    if ('error' in result || common.quiet) return;
    const lines = `${linesOf(this.plan, result)}\n`;
    if (common.output === '-') process.stderr.write(lines);
    else await writeOut(lines);
  }
}
