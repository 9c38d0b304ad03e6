import { placeMore } from './more.js';
import type { Handle, Job, TextureHandle } from './single/fast_winding.js';
import type { Request } from './protocol.js';

/** The module that wasm-bindgen makes: the same for both builds as far as it is used here. */
export type Glue = typeof import('./single/fast_winding.js');
export type Progress = ((fraction: number, stage: string) => void) | undefined;
/** Asked without an argument, it says whether it wants to see the normals of now. */
export type Watcher = ((normals?: Float32Array) => boolean) | undefined;

/** Methods of the engine that make a shape. */
const MAKERS = { parse: 'parse', soup: 'soup', cloud: 'cloud' } as const;

/** Methods that take a cloud as it came. */
const WITHOUT_FIELD = ['free', 'export', 'geometry'];

/** What is asked of the engine, not of a shape, and whether it reports progress. */
const FUNCTIONS = {
  voxelSurface: false, compareVoxels: false, exportVoxels: false,
  exportLayer: false, exportLayers: false, toolpaths: true, gcode: false, printSettings: false,
} as const;

/** Methods that take the part of the WebAssembly that comes later, whatever the shape. */
const BY_MORE = ['noise', 'surface', 'slice', 'layerSpans', 'voxelBricks', 'save', 'signedDistance', 'distanceLattice', 'closestPoints', 'offset', 'hollow', 'check', 'orientFaces', 'repair', 'boolean', 'texture', 'suggestOffset', 'project', ...Object.keys(FUNCTIONS)];

/** Ways of making voxels that take it. */
const VOXELS_BY_MORE = ['continuation', 'rays', 'fast', 'cloud'];

/** How saved fields begin, and archives such as 3MF: what reads them comes later too. */
const READ_BY_MORE = [[0x89, 0x46, 0x57], [0x50, 0x4b]];
const beginsSo = (bytes: unknown) => bytes instanceof Uint8Array && READ_BY_MORE.some((start) => start.every((byte, k) => bytes[k] === byte));

/** Progress that never falls, and ends at 1: what a shape takes before it can answer is told as a part of the call. */
class Rising {
  private told = 0;
  private stage = '';

  constructor(private readonly progress: NonNullable<Progress>) {}

  readonly tell = (fraction: number, stage: string) => {
    this.told = Math.max(this.told, fraction);
    this.stage = stage;
    this.progress(this.told, stage);
  };

  end(): void {
    if (this.stage && this.told < 1) this.progress(1, this.stage);
  }
}

/** The shapes and textures of one instance of the WebAssembly, and the calls to them. */
export class Engine {
  readonly job: Job;
  private readonly handles = new Map<number, Handle | TextureHandle>();

  constructor(private readonly glue: Glue) {
    this.job = new glue.Job();
  }

  get version(): string {
    return this.glue.version();
  }

  /** Whether a call takes the part of the WebAssembly that comes later. */
  needsMore({ method, handle, args }: Request): boolean {
    if (method === 'parse' && (args[1] === 'field' || beginsSo(args[0]))) return true;
    if (method === 'voxelize') {
      const { method: how = '', surface } = (args[0] ?? {}) as { method?: string; surface?: boolean };
      if (surface || VOXELS_BY_MORE.includes(how)) return true;
    }
    if (method === 'parse' || method === 'cloud') return (args.at(-1) as { orient?: string } | undefined)?.orient !== undefined;
    if (BY_MORE.includes(method) || (method === 'export' && args[0] === '3mf')) return true;
    const held = this.handles.get(handle);
    if (held instanceof this.glue.TextureHandle) return true;
    return !WITHOUT_FIELD.includes(method) && (held?.isRaw() ?? false);
  }

  /** Runs one call. Throws what the WebAssembly throws. */
  run(request: Request, progress: Progress, watcher?: Watcher): unknown {
    const rising = progress && new Rising(progress);
    this.job.listen(rising?.tell);
    this.job.watch(watcher);
    if (this.needsMore(request)) placeMore();
    const value = this.answer(request);
    rising?.end();
    return value;
  }

  private answer({ method, handle, args, makes }: Request): unknown {
    if (method in FUNCTIONS) return this.runFunction(method as keyof typeof FUNCTIONS, args);
    if (method in MAKERS) return this.make(MAKERS[method as keyof typeof MAKERS], handle, args);
    if (method === 'free') return this.free(handle);
    const held = this.handles.get(handle);
    if (!held) throw { code: 'Freed', message: 'this was freed', details: {} };
    if (method === 'boolean') return this.combine(held as Handle, args);
    const call = held[method as keyof typeof held] as (...args: unknown[]) => unknown;
    const value = call.apply(held, [...args, this.job]);
    return makes === undefined ? value : this.keep(makes, value as { handle: Handle | TextureHandle });
  }

  /** Keeps a shape or a texture that came of a shape, and describes it in its place. */
  private keep(id: number, { handle, ...rest }: { handle: Handle | TextureHandle }): unknown {
    this.handles.set(id, handle);
    return { ...rest, shape: handle.describe() };
  }

  private runFunction(name: keyof typeof FUNCTIONS, args: unknown[]): unknown {
    const call = this.glue[name] as (...args: unknown[]) => unknown;
    return call(...args, ...(FUNCTIONS[name] ? [this.job] : []));
  }

  private make(maker: keyof typeof MAKERS, id: number, args: unknown[]): unknown {
    const make = this.glue.Handle[maker] as (...args: unknown[]) => Handle;
    const handle = make.apply(this.glue.Handle, [...args, this.job]);
    this.handles.set(id, handle);
    return handle.describe();
  }

  /** The other operand comes as the number of its handle, and how it is moved. */
  private combine(shape: Handle, [operation, other, transform, options]: unknown[]): unknown {
    const second = this.handles.get(other as number) as Handle | undefined;
    if (!second) throw { code: 'Freed', message: 'the other shape was freed', details: {} };
    return shape.boolean(operation as string, second.operand(transform, this.job), options, this.job);
  }

  private free(id: number): void {
    this.handles.get(id)?.free();
    this.handles.delete(id);
  }
}
