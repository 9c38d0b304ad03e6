import { WindingError } from 'fast-winding';

/** Something that went wrong, in words for the person at the page. */
export interface Problem {
  readonly title: string;
  readonly detail: string;
}

export function isAborted(error: unknown): boolean {
  return error instanceof WindingError ? error.code === 'Aborted' : error instanceof DOMException && error.name === 'AbortError';
}

export function isLost(error: unknown): boolean {
  return error instanceof WindingError && (error.code === 'Crashed' || error.code === 'Freed');
}

export function problemOf(title: string, error: unknown): Problem {
  const message = error instanceof Error ? error.message : String(error);
  return { title, detail: sentence(message) };
}

/** The package's messages begin in lower case and have no full stop. */
export function sentence(message: string): string {
  const text = message.trim();
  const start = text.charAt(0).toUpperCase() + text.slice(1);
  return /[.!?]$/.test(start) ? start : `${start}.`;
}

/** By its names, what was kept and is not there again. */
export function lost(titles: readonly string[]): Problem {
  return { title: 'Not all that was kept is there again', detail: `Not readable any more: ${titles.join(', ')}.` };
}
