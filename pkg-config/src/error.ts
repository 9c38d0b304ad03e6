/** What went wrong, for programs. These names stay. */
export type ErrorCode =
  | 'ParseError'
  | 'UnknownFormat'
  | 'NonFiniteVertex'
  | 'IndexOutOfRange'
  | 'EmptyInput'
  | 'EmptyResult'
  | 'MissingNormals'
  | 'InvalidArgument'
  | 'OutOfMemory'
  | 'DoesNotFit'
  | 'Unsupported'
  | 'LoadFailed'
  | 'Aborted'
  | 'Crashed'
  | 'Freed';

/** An error that can be posted from a worker. */
export interface ErrorData {
  code: ErrorCode;
  message: string;
  details: Record<string, unknown>;
}

/**
 * The one error class of this package. `details` by code: `ParseError` { format, byte | line, expected },
 * `NonFiniteVertex` { vertex }, `IndexOutOfRange` { triangle, index, vertices }, `OutOfMemory` { bytes },
 * `Aborted` { reason }. `EmptyResult` says that nothing is left of a shape, or no cavity. `DoesNotFit` says that a print is larger than its printer, or off its bed,
 * or that the charts of a texture and their margins do not fit into its texels.
 */
export class WindingError extends Error {
  /** What went wrong, for programs. */
  readonly code: ErrorCode;
  /** More, by code. */
  readonly details: Record<string, unknown>;

  constructor(code: ErrorCode, message: string, details: Record<string, unknown> = {}) {
    super(message);
    this.name = 'WindingError';
    this.code = code;
    this.details = details;
  }

  /** @internal */
  static from({ code, message, details }: ErrorData): WindingError {
    return new WindingError(code, message, details);
  }
}

function isErrorData(thrown: unknown): thrown is ErrorData {
  return typeof thrown === 'object' && thrown !== null && 'code' in thrown && 'details' in thrown;
}

/**
 * What the engine threw, as data. `fatal` when the instance cannot go on: it trapped, or ran out of stack.
 * A panic is not fatal: it unwound.
 */
export function describeError(thrown: unknown): { error: ErrorData; fatal: boolean } {
  if (isErrorData(thrown)) {
    return { error: { code: thrown.code, message: thrown.message, details: thrown.details }, fatal: false };
  }
  const { name, message } = thrown instanceof Error ? thrown : new Error(String(thrown));
  if (name === 'TypeError') return { error: { code: 'InvalidArgument', message, details: {} }, fatal: false };
  return { error: { code: 'Crashed', message: `the engine crashed: ${message}`, details: {} }, fatal: name !== 'PanicError' };
}
