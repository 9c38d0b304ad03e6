// Numbers and sizes as people read them.
import type { Bounds, Warning } from '../api.js';

/** Up to so many significant digits, thousands apart. */
export function figure(value: number, digits = 4): string {
  return value.toLocaleString('en-US', { maximumSignificantDigits: Number.isInteger(value) ? 21 : digits });
}

export const length = (value: number): string => `${figure(value)} mm`;
export const area = (value: number): string => `${figure(value)} mm²`;
export const volume = (value: number): string => `${figure(value)} mm³`;
export const plural = (count: number, noun: string): string => `${figure(count)} ${noun}${count === 1 ? '' : 's'}`;

/** Width, depth and height. */
export function sizeOf({ min, max }: Bounds): string {
  return `${[0, 1, 2].map((axis) => figure(max[axis]! - min[axis]!)).join(' × ')} mm`;
}

export const counts = (numbers: readonly number[]): string => numbers.map((count) => figure(count)).join(' × ');

/** A row for each warning. */
export function warningRows(warnings: readonly Pick<Warning, 'message'>[]): [string, string][] {
  return warnings.map(({ message }) => ['warning', message]);
}

/** JSON of what a report holds: typed arrays as lists, numbers that are none as null. */
export function toJson(value: unknown): string {
  return JSON.stringify(value, (_, inner) => (ArrayBuffer.isView(inner) ? Array.from(inner as unknown as ArrayLike<number>) : inner));
}
