// Options of the command line as the commands' tables describe them, and the values that come of them.
import { UsageError } from './usage.js';

interface Described {
  help: string;
  /** The command does not run without it. */
  isRequired?: true;
  /** A letter for short. */
  short?: string;
}

/** An option: its flag is its key in the table, `layerHeight` being `--layer-height`. */
export type Option = Described &
  (
    | { kind: 'flag' }
    | { kind: 'number' | 'whole' | 'text'; value: string }
    | { kind: 'choice'; choices: readonly string[] }
    /** So many numbers with commas between them. */
    | { kind: 'numbers'; value: string; count: number }
    /** The same, given as often as one likes. */
    | { kind: 'lists'; value: string; count: number }
  );
export type Options = Readonly<Record<string, Option>>;

type ValueOf<O> = O extends { kind: 'flag' } ? boolean
  : O extends { kind: 'number' | 'whole' } ? number
  : O extends { kind: 'text' } ? string
  : O extends { kind: 'choice'; choices: readonly (infer C)[] } ? C
  : O extends { kind: 'numbers' } ? number[]
  : O extends { kind: 'lists' } ? number[][]
  : never;
/** What was given: nothing for options that were not. */
export type Values<O extends Options> = { [K in keyof O]?: ValueOf<O[K]> };

/** Options for the package, without those that were not given. */
export function given<T extends object>(options: T): T {
  return Object.fromEntries(Object.entries(options).filter(([, value]) => value !== undefined)) as T;
}

/** The option's name on the command line, without its dashes. */
export const flagOf = (key: string): string => key.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);

function numberOf(text: string, flag: string): number {
  const value = text.trim() === '' ? NaN : Number(text);
  if (!Number.isFinite(value)) throw new UsageError(`--${flag} is ${JSON.stringify(text)}: a number is needed`);
  return value;
}

function listOf(text: string, flag: string, count: number): number[] {
  const list = text.split(',').map((part) => numberOf(part, flag));
  if (list.length !== count) throw new UsageError(`--${flag} is ${JSON.stringify(text)}: ${count} numbers with commas between them are needed`);
  return list;
}

/** An option's value from what parseArgs makes of it. */
export function valueOf(option: Option, given: string | boolean | (string | boolean)[], flag: string): unknown {
  if (Array.isArray(given)) return option.kind === 'lists' ? given.map((text) => listOf(String(text), flag, option.count)) : given;
  if (typeof given === 'boolean' || option.kind === 'text') return given;
  switch (option.kind) {
    case 'number':
      return numberOf(given, flag);
    case 'whole': {
      const value = numberOf(given, flag);
      if (!Number.isInteger(value) || value < 0) throw new UsageError(`--${flag} is ${given}: a whole number from 0 is needed`);
      return value;
    }
    case 'choice':
      if (option.choices.includes(given)) return given;
      throw new UsageError(`--${flag} is ${JSON.stringify(given)}: one of ${option.choices.join(', ')} is needed`);
    case 'numbers':
      return listOf(given, flag, option.count);
    default:
      return given;
  }
}
