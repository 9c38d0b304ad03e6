// What a command of the command line is.
import type { CallOptions, Cloud, FastWinding, Soup } from '../api.js';
import type { Options, Values } from './options.js';

/** What a command works on. */
export interface Task {
  readonly fw: FastWinding;
  /** One, or all that were named for a command that takes them together. */
  readonly shapes: readonly (Soup | Cloud)[];
  /** Words between the command and the files, such as the operation of `boolean`. */
  readonly words: readonly string[];
  /** For each call that may take long: how it is stopped, who hears of progress. */
  readonly call: Required<CallOptions>;
  /** Reads one more file. */
  open(path: string): Promise<Soup | Cloud>;
  readBytes(path: string): Promise<Uint8Array>;
  /** Format of the file that is wanted, one of the command's; `undefined` if none is. */
  readonly format: string | undefined;
  /** Writes what is wanted: a file, or one part of several, which then has that after its name. */
  save(bytes: Uint8Array, part?: string): Promise<void>;
  /** Writes a file with another ending beside the one that is wanted; the command's `beside` names the endings. */
  saveBeside(bytes: Uint8Array, ending: string): Promise<void>;
  /** Name of the file that is wanted, without its folder and ending. */
  readonly stem: string;
}

/** What came of it. */
export interface Outcome {
  /** For programs; typed arrays become lists. */
  report: object;
  /** For people: a line, and rows of names and values. */
  headline: string;
  rows?: readonly (readonly [string, string])[];
  /** Of `check`: whether it prints. */
  passes?: boolean;
}

export interface Command<O extends Options = Options> {
  name: string;
  /** For the list of commands: a line. */
  summary: string;
  /** Paragraphs for its own help. */
  description: readonly string[];
  /** What comes before the files: their names, and what each may be. */
  words?: readonly { name: string; choices: readonly string[] }[];
  /** Whether it takes files one by one, or all together, and then how many at least. */
  files: 'each' | { atLeast: number };
  options: O;
  /** What it can write, by ending; the first where nothing else decides. Empty if it writes nothing. */
  formats: readonly string[];
  /** Options that must not be given together, or only with others: throws a {@link UsageError}. */
  verify?(values: Values<NoInfer<O>>): void;
  /** The one format that goes with these options, where they decide. */
  formatFor?(values: Values<NoInfer<O>>): string | undefined;
  /** Whether it writes many files for each input, so that `-o` is a folder. */
  writesParts?(values: Values<NoInfer<O>>): boolean;
  /** Endings of the files that go beside one of this format; then `-o` is not standard output. */
  beside?(format: string, values: Values<NoInfer<O>>): readonly string[];
  examples: readonly string[];
  /** Whether clouds get normals if they have none; they do unless this is false. */
  orientsClouds?: false;
  run(task: Task, values: Values<NoInfer<O>>): Promise<Outcome>;
}

/** A command of the table, its options' types checked where it is written. */
export const command = <const O extends Options>(described: Command<O>): Command => described as unknown as Command;
