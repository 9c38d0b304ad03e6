import type { Request } from './protocol.js';

/** Whether a call changes what a shape is, and so must be repeated when it is rebuilt. */
const changes = ({ method, args }: Request) =>
  ['orient', 'orientFaces'].includes(method) ||
  (method === 'prepare' && (args[0] as { bounded?: boolean } | undefined)?.bounded !== undefined);

const MAKERS = new Set(['parse', 'soup', 'cloud']);

function bytesOf(args: unknown[]): number {
  return args.reduce<number>((sum, arg) => sum + (ArrayBuffer.isView(arg) ? arg.byteLength : 0), 0);
}

/** The calls that made the living shapes, so that a new worker can make them again. */
export class Sources {
  private readonly requests = new Map<number, Request[]>();

  /** Bytes kept. */
  get bytes(): number {
    return [...this.requests.values()].flat().reduce((sum, { args }) => sum + bytesOf(args), 0);
  }

  /** Notes a call that succeeded. */
  note(request: Request): void {
    const { method, handle } = request;
    if (MAKERS.has(method)) this.requests.set(handle, [request]);
    else if (changes(request)) this.requests.get(handle)?.push(request);
    else if (method === 'free') this.requests.delete(handle);
  }

  /** All calls to repeat, in an order that works. */
  all(): Request[] {
    return [...this.requests.values()].flat();
  }
}
