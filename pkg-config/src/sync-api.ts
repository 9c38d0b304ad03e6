import type * as api from './api.js';
import type { SyncDistances } from './distance-api.js';

/** The same, with plain values where promises were. */
type Plain<T> = T extends (...args: infer A) => Promise<infer R>
  ? (...args: A) => R
  : T extends (...args: infer A) => AsyncIterable<infer R>
    ? (...args: A) => Iterable<R>
    : T;
type Synchronous<T> = { [K in keyof T]: Plain<T[K]> };

/** As in the other entry. */
type Combine = (operation: api.BooleanOperation, other: Shape, options?: api.BooleanOptions) => api.BooleanResult<Soup>;

/** Triangles, as in the other entry; methods give their values at once. */
export interface Soup extends Omit<Synchronous<api.Soup>, 'toCloud' | 'repair' | 'texture' | 'boolean' | keyof SyncDistances>, SyncDistances {
  boolean: Combine;
  /** As in the other entry. */
  toCloud(options?: Parameters<api.Soup['toCloud']>[0]): Cloud;
  repair(options?: api.RepairOptions): api.Repaired<Soup>;
  texture(options?: api.TextureOptions): Texture;
}
/** Points, as in the other entry; methods give their values at once. */
export interface Cloud extends Omit<Synchronous<api.Cloud>, 'repair' | 'boolean' | keyof SyncDistances>, SyncDistances {
  boolean: Combine;
  repair(options?: api.RemeshOptions): api.Repaired<Soup>;
}
/** What `open` gives: `kind` tells which. */
export type Shape = Soup | Cloud;
/** A textured soup, as in the other entry. */
export type Texture = Synchronous<api.Texture>;

/** An engine that answers at once, on the thread that asks. */
export interface FastWinding extends Omit<Synchronous<api.FastWinding>, 'open' | 'load' | 'Soup' | 'Cloud'> {
  /** Reads a file of any known format: STL, OBJ, PLY, XYZ, OFF, 3MF, and what `save` gives. */
  open(bytes: api.Bytes, options?: api.ReadOptions & api.CallOptions): Soup | Cloud;
  /** Reads what `save` gives, and nothing else. */
  load(bytes: api.Bytes, options?: { transfer?: boolean } & api.CallOptions): Soup | Cloud;
  readonly Soup: {
    /** Reads a file that must hold triangles. */
    parse(bytes: api.Bytes, options?: api.ReadOptions & api.CallOptions): Soup;
    from(data: api.SoupArrays, options?: { transfer?: boolean }): Soup;
  };
  readonly Cloud: {
    /** Reads a file that must hold points. */
    parse(bytes: api.Bytes, options?: api.ReadOptions & api.CallOptions): Cloud;
    from(data: api.CloudArrays, options?: { orient?: 'auto'; transfer?: boolean }): Cloud;
  };
}
