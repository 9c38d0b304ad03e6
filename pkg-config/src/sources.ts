import type { Request } from './protocol.js';

/** Whether a call changes what a shape is, and so must be repeated when it is rebuilt. */
const changes = ({ method, args }: Request) =>
  method === 'orient' || (method === 'prepare' && (args[0] as { bounded?: boolean } | undefined)?.bounded !== undefined);

const MAKERS = new Set(['parse', 'soup', 'cloud']);

function bytesOf(args: unknown[]): number {
  return args.reduce<number>((sum, arg) => sum + (ArrayBuffer.isView(arg) ? arg.byteLength : 0), 0);
}

/** The calls that made the living shapes, so that a new worker can make them again. */
export class Sources {
  private readonly requests = new Map<number, Request[]>();
  /** Of each shape that was made of another, that one. */
  private readonly parents = new Map<number, number>();
  /** Shapes that were freed, but others were made of them. */
  private readonly freed = new Set<number>();

  /** Bytes kept. */
  get bytes(): number {
    return [...this.requests.values()].flat().reduce((sum, { args }) => sum + bytesOf(args), 0);
  }

  /** Notes a call that succeeded. */
  note(request: Request): void {
    const { method, handle, makes } = request;
    if (makes !== undefined) {
      this.requests.set(makes, [request]);
      this.parents.set(makes, handle);
    } else if (MAKERS.has(method)) this.requests.set(handle, [request]);
    else if (changes(request)) this.requests.get(handle)?.push(request);
    else if (method === 'free') this.forget(handle);
  }

  private forget(handle: number): void {
    if ([...this.parents.values()].includes(handle)) {
      this.freed.add(handle);
      return;
    }
    this.requests.delete(handle);
    this.freed.delete(handle);
    const parent = this.parents.get(handle);
    this.parents.delete(handle);
    if (parent !== undefined && this.freed.has(parent)) this.forget(parent);
  }

  /** All calls to repeat, in an order that works. */
  all(): Request[] {
    const frees = [...this.freed].map((handle): Request => ({ method: 'free', handle, args: [] }));
    return [...[...this.requests.values()].flat(), ...frees];
  }
}
