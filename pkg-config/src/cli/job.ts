// One job: its inputs opened, the command run, its shapes freed, whatever happens.
import type { Cloud, FastWinding, Soup } from '../api.js';
import { WindingError } from '../error.js';
import type { Plan } from './arguments.js';
import { type Destination, Writer, stemOf } from './destination.js';
import { FileError, read } from './files.js';
import type { Progress } from './progress.js';
import type { Result } from './report.js';

/** What surrounds all jobs of a run. */
export interface Run {
  readonly plan: Plan;
  readonly progress: Progress;
  readonly signal: AbortSignal;
}

/** Says which of several inputs an error is of. */
function named(error: unknown, path: string, isOneOfMany: boolean): unknown {
  if (!isOneOfMany) return error;
  if (error instanceof WindingError) return new WindingError(error.code, `${path}: ${error.message}`, error.details);
  return error instanceof FileError ? new FileError(error.code, `${path}: ${error.message}`) : error;
}

/** The error as data: of ours, of a file, or one that should not be. */
function describe(error: unknown): { code: string; message: string; details: object } {
  if (error instanceof WindingError) return { code: error.code, message: error.message, details: error.details };
  const { code, message } = error as NodeJS.ErrnoException;
  return { code: code ?? 'Unexpected', message, details: {} };
}

async function attempt({ plan, progress, signal }: Run, names: readonly string[], destination: Destination | undefined, fw: FastWinding): Promise<Result> {
  const { command, common, values, words } = plan;
  const writer = destination && new Writer(destination, common.force ?? false, signal);
  await writer?.ready();
  const call = { signal, onProgress: (fraction: number, stage: string) => progress.tell(names[0]!, fraction, stage) };
  const opened: (Soup | Cloud)[] = [];
  const open = async (path: string, isOneOfMany: boolean) => {
    try {
      const bytes = await read(path, signal);
      const orient = command.orientsClouds === false ? {} : { orient: 'auto' as const };
      const shape = await fw.open(bytes, { unit: common.unit ?? 'millimeter', transfer: true, ...orient, ...call });
      opened.push(shape);
      return shape;
    } catch (error) {
      throw named(error, path, isOneOfMany);
    }
  };
  try {
    const shapes: (Soup | Cloud)[] = [];
    for (const name of names) shapes.push(await open(name, names.length > 1));
    const task = {
      fw,
      shapes,
      words,
      call,
      open: (path: string) => open(path, true),
      readBytes: async (path: string) => {
        try {
          return await read(path, signal);
        } catch (error) {
          throw named(error, path, true);
        }
      },
      format: destination?.format,
      stem: stemOf(destination?.path ?? names[0]!),
      save: (bytes: Uint8Array, part?: string) => writer!.save(bytes, part),
      saveBeside: (bytes: Uint8Array, ending: string) => writer!.saveBeside(bytes, ending),
    };
    const outcome = await command.run(task, values);
    return { names, outcome, warnings: shapes.flatMap(({ warnings }) => warnings), written: writer?.written ?? [] };
  } finally {
    for (const shape of opened) shape.free();
  }
}

/** Runs one job; its errors are results too. */
export async function runJob(run: Run, names: readonly string[], destination: Destination | undefined, engine: () => Promise<FastWinding>): Promise<Result> {
  try {
    return await attempt(run, names, destination, await engine());
  } catch (error) {
    return { names, error: describe(error) };
  } finally {
    run.progress.finish();
  }
}
