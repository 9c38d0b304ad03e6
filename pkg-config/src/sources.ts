import type { Request } from './protocol.js';

/** Whether a call changes what a shape or a texture is, and so must be repeated when it is rebuilt. */
const changes = ({ method, args }: Request) =>
  ['orient', 'orientFaces', 'remap'].includes(method) ||
  (method === 'prepare' && (args[0] as { bounded?: boolean } | undefined)?.bounded !== undefined);

const MAKERS = new Set(['parse', 'soup', 'cloud']);

function bytesOf(args: unknown[]): number {
  return args.reduce<number>((sum, arg) => sum + (ArrayBuffer.isView(arg) ? arg.byteLength : 0), 0);
}

/** The calls that made the living shapes and textures, so that a new worker can make them again. */
export class Sources {
  private readonly requests = new Map<number, { place: number; request: Request }[]>();
  /** Of each shape that was made of another, that one. */
  private readonly parents = new Map<number, number>();
  /** Shapes that were freed, but others were made of them. */
  private readonly freed = new Set<number>();
  private count = 0;

  /** Bytes kept. */
  get bytes(): number {
    return [...this.requests.values()].flat().reduce((sum, { request }) => sum + bytesOf(request.args), 0);
  }

  /** Notes a call that succeeded. */
  note(request: Request): void {
    const { method, handle, makes } = request;
    const noted = { place: this.count++, request };
    if (makes !== undefined) {
      this.requests.set(makes, [noted]);
      this.parents.set(makes, handle);
    } else if (MAKERS.has(method)) this.requests.set(handle, [noted]);
    else if (changes(request)) this.requests.get(handle)?.push(noted);
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

  /** All calls to repeat, in the order in which they were made: what is made of a shape is made of it as it was then. */
  all(): Request[] {
    const noted = [...this.requests.values()].flat().sort((one, other) => one.place - other.place);
    const frees = [...this.freed].map((handle): Request => ({ method: 'free', handle, args: [] }));
    return [...noted.map(({ request }) => request), ...frees];
  }
}
