// The help, made from the table of commands.
import { COMMON } from './arguments.js';
import type { Command } from './command.js';
import { COMMANDS } from './commands/index.js';
import { type Option, type Options, flagOf } from './options.js';

const WIDTH = 96;
const LABEL = 28;

/** Words in lines of at most `WIDTH` characters, all but the first behind `indent` spaces. */
function wrap(text: string, indent: number): string {
  const lines: string[] = [];
  let line = '';
  for (const word of text.split(' ')) {
    if (line && line.length + 1 + word.length > WIDTH - indent) {
      lines.push(line);
      line = word;
    } else {
      line = line ? `${line} ${word}` : word;
    }
  }
  return [...lines, line].join(`\n${' '.repeat(indent)}`);
}

function row(label: string, text: string): string {
  const start = label.length > LABEL - 4 ? `  ${label}\n${' '.repeat(LABEL)}` : `  ${label}`.padEnd(LABEL);
  return start + wrap(text, LABEL);
}

function optionRow([key, option]: [string, Option]): string {
  const value = option.kind === 'flag' ? '' : option.kind === 'choice' ? ' NAME' : ` ${option.value}`;
  const choices = option.kind === 'choice' && !option.choices.every((choice) => option.help.includes(choice)) ? `: ${option.choices.join(', ')}` : '';
  const required = option.isRequired ? ' (required)' : '';
  return row(`${option.short ? `-${option.short}, ` : ''}--${flagOf(key)}${value}`, `${option.help}${choices}${required}`);
}

const section = (title: string, rows: readonly string[]): string => (rows.length === 0 ? '' : `\n${title}\n${rows.join('\n')}\n`);
const optionRows = (options: Options): string[] => Object.entries(options).map(optionRow);
const exampleRows = (examples: readonly string[]): string[] => examples.map((example) => `  fast-winding ${example}`);

const either = (names: readonly string[]): string => names.join(', ').replace(/, ([^,]*)$/, ' or $1');

/** Help for one command. */
export function helpOf({ name, summary, description, words = [], files, options, formats, examples }: Command): string {
  const named = [...words.map((word) => word.name), files === 'each' ? 'FILE…' : 'FILE FILE…'].join(' ');
  const choices = words.map((word) => row(word.name, word.choices.join(', ')));
  const writes = formats.length > 0 ? [`With -o it writes ${either(formats)}; without there is only the report.`] : [];
  const common: Options = formats.length > 0 ? COMMON : (({ output, format, force, ...rest }) => rest)(COMMON);
  return [
    `fast-winding ${name} ${named} [options]\n\n${summary}\n`,
    ...[...description, ...writes].map((paragraph) => `\n${wrap(paragraph, 0)}\n`),
    section('Arguments', choices),
    section('Options', optionRows(options)),
    section('Options of every command', optionRows(common)),
    section('Examples', exampleRows(examples)),
  ].join('');
}

const ABOUT = [
  'Reads STL, OBJ, PLY, OFF, 3MF and XYZ, whatever the file is called, and fields that were saved; - is standard input. Lengths are in millimetres, angles in degrees. Points without normals get them first.',
  'With -o the result is written as its ending says, whole or not at all, and never over a file that exists unless --force is given. Many inputs go to a folder, under their own names. One that fails does not stop the others.',
];
const EXITS = [
  ['0', 'all is well'],
  ['1', 'an input failed: standard error says which, and why'],
  ['2', 'wrong use: nothing was done'],
  ['3', 'of check: all could be read, and one does not print as it is'],
  ['130', 'interrupted'],
] as const;

/** Examples of many files, and of other programs before and after. */
const STREAMS = ['check --json models/*.stl > reports.jsonl', 'repair - -o - --format ply < broken.stl > fixed.ply'];

/** Help for the whole. */
export function help(): string {
  return [
    'fast-winding COMMAND FILE… [options]\n\n',
    `${wrap('Inside or outside? Checks, repairs, layers, voxels, surfaces and booleans of meshes and point clouds as they are found: with holes, flips and self-intersections.', 0)}\n`,
    section('Commands', COMMANDS.map(({ name, summary }) => row(name, summary))),
    section('Options of every command', [...optionRows(COMMON), row('-V, --version', 'version')]),
    ...ABOUT.map((paragraph) => `\n${wrap(paragraph, 0)}\n`),
    section('Exit codes', EXITS.map(([code, meaning]) => row(code, meaning))),
    section('Examples', exampleRows([...COMMANDS.slice(1, 6).map(({ examples }) => examples[0]!), ...STREAMS])),
    '\nfast-winding COMMAND --help tells more.\n',
  ].join('');
}
