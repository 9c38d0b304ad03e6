// What was typed, understood: a command with its files and options, or a wish for help.
import { parseArgs } from 'node:util';
import type { ReadOptions } from '../api.js';
import type { Command } from './command.js';
import { COMMANDS } from './commands/index.js';
import { type Options, type Values, flagOf, valueOf } from './options.js';
import { UsageError } from './usage.js';

/** Options of every command. */
export const COMMON = {
  output: { kind: 'text', short: 'o', value: 'OUT', help: 'file to write, its format by its ending; a folder for many files; - for standard output' },
  format: { kind: 'text', value: 'FORMAT', help: 'format to write, where no ending tells' },
  force: { kind: 'flag', help: 'overwrite files that exist' },
  json: { kind: 'flag', help: 'one JSON document on a line for each input, and nothing else on standard output' },
  unit: {
    kind: 'choice',
    choices: ['micron', 'millimeter', 'centimeter', 'inch', 'foot', 'meter'],
    help: 'unit of files that do not state theirs (millimeter)',
  },
  threads: { kind: 'whole', value: 'N', help: 'threads in all (one for each processor); 0 for the build without' },
  jobs: { kind: 'whole', value: 'N', help: 'files at once, which share the threads (one for each thread, 8 at most)' },
  quiet: { kind: 'flag', short: 'q', help: 'no progress, and no report where all is well' },
  help: { kind: 'flag', short: 'h', help: 'this' },
} as const satisfies Options;

/** What is to be done. */
export interface Plan {
  readonly command: Command;
  readonly words: readonly string[];
  readonly files: readonly string[];
  readonly values: Values<Options>;
  readonly common: Omit<Values<typeof COMMON>, 'unit'> & { unit?: ReadOptions['unit'] };
}
export type Wish = { help: Command | undefined } | { version: true } | { plan: Plan };

function commandNamed(name: string): Command {
  const command = COMMANDS.find((known) => known.name === name);
  if (command) return command;
  throw new UsageError(`${JSON.stringify(name)} is no command: ${COMMANDS.map((known) => known.name).join(', ')} are`);
}

/** Joins an option and a negative number after it, which parseArgs would take for another option. */
function withNegatives(argv: readonly string[]): string[] {
  const joined: string[] = [];
  for (const word of argv) {
    const before = joined.at(-1);
    if (/^-[\d.]/.test(word) && before && /^--[^=]+$/.test(before)) joined[joined.length - 1] = `${before}=${word}`;
    else joined.push(word);
  }
  return joined;
}

function parse(argv: readonly string[], options: Options, command: Command): { given: Values<Options>; positionals: string[] } {
  const described = Object.entries(options).map(([key, { kind, short }]) => [
    flagOf(key),
    { type: kind === 'flag' ? ('boolean' as const) : ('string' as const), multiple: kind === 'lists', ...(short && { short }) },
  ]);
  try {
    const { values, positionals } = parseArgs({ args: withNegatives(argv), options: Object.fromEntries(described), allowPositionals: true });
    const typed = values as Record<string, string | boolean | string[] | undefined>;
    const given: Record<string, unknown> = {};
    for (const [key, option] of Object.entries(options)) {
      const value = typed[flagOf(key)];
      if (value !== undefined) given[key] = valueOf(option, value, flagOf(key));
    }
    return { given: given as Values<Options>, positionals };
  } catch (error) {
    if (error instanceof UsageError) throw new UsageError(error.message, command.name);
    // Its first sentence: the others tell programmers what to do.
    throw new UsageError((error as Error).message.split(/\.\s|\n/)[0]!, command.name);
  }
}

function verify({ command, words, files, values, common }: Plan): void {
  command.words?.forEach(({ name, choices }, i) => {
    if (!choices.includes(words[i] ?? '')) throw new UsageError(`${name} is ${JSON.stringify(words[i] ?? '')}: one of ${choices.join(', ')} is needed`);
  });
  const least = command.files === 'each' ? 1 : command.files.atLeast;
  if (files.length < least) throw new UsageError(least === 1 ? 'no file is named' : `${command.name} takes ${least} files at least`);
  if (files.filter((file) => file === '-').length > 1) throw new UsageError('standard input can be read only once');
  if (common.jobs === 0) throw new UsageError('--jobs is 0: a whole number from 1 is needed');
  for (const [key, { isRequired }] of Object.entries(command.options)) {
    if (isRequired && values[key] === undefined) throw new UsageError(`--${flagOf(key)} is missing`);
  }
  command.verify?.(values);
}

/** Understands what was typed, or throws a {@link UsageError}. */
export function understand([name, ...rest]: readonly string[]): Wish {
  if (name === '--version' || name === '-V') return { version: true };
  if (name === '--help' || name === '-h') return { help: undefined };
  if (name === 'help') return { help: rest[0] === undefined ? undefined : commandNamed(rest[0]) };
  if (name === undefined) throw new UsageError('a command is missing');
  if (name.startsWith('-')) throw new UsageError(`a command comes first, not ${name}`);
  const command = commandNamed(name);
  const own = parse(rest, { ...command.options, ...COMMON }, command);
  const common = Object.fromEntries(Object.keys(COMMON).map((key) => [key, own.given[key]])) as Plan['common'];
  if (common.help) return { help: command };
  const values = Object.fromEntries(Object.keys(command.options).filter((key) => own.given[key] !== undefined).map((key) => [key, own.given[key]!]));
  const count = command.words?.length ?? 0;
  const plan = { command, words: own.positionals.slice(0, count), files: own.positionals.slice(count), values, common };
  try {
    verify(plan);
  } catch (error) {
    throw error instanceof UsageError ? new UsageError(error.message, command.name) : error;
  }
  return { plan };
}
