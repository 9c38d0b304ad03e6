// Where results go, by `-o`, `--format` and the names of the inputs.
import { statSync } from 'node:fs';
import { basename, dirname, extname, join } from 'node:path';
import type { Plan } from './arguments.js';
import { exists, refuse, writeOut, writeWhole } from './files.js';
import { UsageError } from './usage.js';

/** Where one input's result goes: a file, standard output (`-`), or many files that begin with `path`. */
export interface Destination {
  readonly path: string;
  readonly format: string;
  readonly hasParts: boolean;
  /** Endings of the files that are written beside it. */
  readonly beside: readonly string[];
}

export const endingOf = (path: string): string => extname(path).slice(1).toLowerCase();
export const stemOf = (file: string): string => (file === '-' ? 'stdin' : basename(file, extname(file)));

/** What is there already; what cannot be looked at will fail when it is written. */
function kindAt(path: string): 'folder' | 'file' | 'nothing' {
  try {
    return statSync(path).isDirectory() ? 'folder' : 'file';
  } catch {
    return 'nothing';
  }
}

const isFolder = (path: string): boolean => /[/\\]$/.test(path) || kindAt(path) === 'folder';

/** The format that options ask for, if they do. */
function formatAsked({ command, values, common }: Plan): string | undefined {
  const decided = command.formatFor?.(values);
  const asked = common.format?.toLowerCase().replace(/^\./, '');
  if (asked !== undefined && !command.formats.includes(asked)) {
    throw new UsageError(`--format is ${JSON.stringify(common.format)}: one of ${command.formats.join(', ')} is needed`, command.name);
  }
  if (decided !== undefined && asked !== undefined && asked !== decided) {
    throw new UsageError(`--format is ${asked}: these options write ${decided}`, command.name);
  }
  return decided ?? asked;
}

function formatOfFile(path: string, { command }: Plan, asked: string | undefined): string {
  const ending = endingOf(path);
  if (asked === undefined && !command.formats.includes(ending)) {
    throw new UsageError(`${path}: its ending is none of ${command.formats.join(', ')}, and no --format is given`, command.name);
  }
  if (asked !== undefined && asked !== ending && command.formats.includes(ending)) {
    throw new UsageError(`${path}: its ending is ${ending}, and ${asked} is to be written`, command.name);
  }
  return asked ?? ending;
}

function verify(plan: Plan, output: string, isMany: boolean, hasParts: boolean): void {
  const { command, common } = plan;
  if (command.formats.length === 0) throw new UsageError(`${command.name} writes no file`, command.name);
  if (output === '-' && common.json) throw new UsageError('standard output cannot take both --json and the result', command.name);
  if (output === '-' && (isMany || hasParts)) throw new UsageError('standard output can take one result only', command.name);
  if (output !== '-' && (isMany || hasParts) && kindAt(output) === 'file') {
    throw new UsageError(`${output} is a file: many results need a folder`, command.name);
  }
}

/** For each of `inputs`, where its result goes; nowhere without `-o`. */
export function destinations(plan: Plan, inputs: readonly string[]): (Destination | undefined)[] {
  const { command, common } = plan;
  const { output } = common;
  if (output === undefined) {
    if (common.format !== undefined || common.force) throw new UsageError('--format and --force are about what -o writes', command.name);
    return inputs.map(() => undefined);
  }
  const hasParts = command.writesParts?.(plan.values) ?? false;
  const isMany = inputs.length > 1;
  verify(plan, output, isMany, hasParts);
  const asked = formatAsked(plan);
  const place = (path: string, format: string): Destination => {
    const beside = command.beside?.(format, plan.values) ?? [];
    if (path === '-' && beside.length > 0) {
      throw new UsageError(`standard output can take one file only: beside ${format} there is ${beside.join(' and ')}`, command.name);
    }
    return { path, format, hasParts, beside };
  };
  if (output !== '-' && !isMany && !hasParts && !isFolder(output)) return [place(output, formatOfFile(output, plan, asked))];
  const taken = new Map<string, string>();
  return inputs.map((input) => {
    const own = endingOf(input);
    const format = asked ?? (command.formats.includes(own) && output !== '-' ? own : command.formats[0]!);
    if (output === '-') return place('-', format);
    const path = join(output, hasParts ? stemOf(input) : `${stemOf(input)}.${format}`);
    const other = taken.get(path);
    if (other !== undefined) throw new UsageError(`${other} and ${input} would both be written to ${path}`, command.name);
    taken.set(path, input);
    return place(path, format);
  });
}

/** Writes one input's results, and notes which files they are. */
export class Writer {
  readonly written: string[] = [];

  constructor(
    private readonly destination: Destination,
    private readonly isForced: boolean,
    private readonly signal: AbortSignal,
  ) {}

  /** Fails, before anything is computed, if what is to be written is there already. */
  async ready(): Promise<void> {
    const { path, hasParts, beside } = this.destination;
    if (path === '-' || hasParts || this.isForced) return;
    for (const file of [path, ...beside.map((ending) => this.besideOf(ending))]) if (await exists(file)) throw refuse(file);
  }

  async save(bytes: Uint8Array, part?: string): Promise<void> {
    const { path, format } = this.destination;
    if (path === '-') return writeOut(bytes);
    await this.write(part === undefined ? path : `${path}-${part}.${format}`, bytes);
  }

  saveBeside(bytes: Uint8Array, ending: string): Promise<void> {
    return this.write(this.besideOf(ending), bytes);
  }

  private async write(file: string, bytes: Uint8Array): Promise<void> {
    await writeWhole(file, bytes, this.isForced, this.signal);
    this.written.push(file);
  }

  private besideOf(ending: string): string {
    const { path } = this.destination;
    return join(dirname(path), `${stemOf(path)}.${ending}`);
  }
}
