// The engine and how it is started, as the package's callers see them.
import type { Cloud, CloudArrays } from './cloud-api.js';
import type { Bytes, CallOptions, ReadOptions } from './common-api.js';
import type { GCode, PrinterProfile, RequiredProfile, Toolpaths, ToolpathSettings } from './print-api.js';
import type { Layer } from './slice-api.js';
import type { Soup, SoupArrays } from './soup-api.js';
import type { VoxelFunctions } from './voxels-api.js';

/** Options of `init`. The same options give the same engine; other options another one. */
export interface InitOptions {
  /** How many threads: `'auto'` (the default) one for each processor, `false` the single-threaded build. */
  threads?: 'auto' | number | false;
  /**
   * Where the WebAssembly lies, when it is not beside the script: the URL of a folder that holds
   * `threads/fast_winding_bg.wasm` and `single/fast_winding_bg.wasm`, or of the one file to use (ending in `.wasm`).
   */
  wasmUrl?: string | URL;
  /** Where `worker.js` lies, when a bundler does not find it by itself. */
  workerUrl?: string | URL;
  /** Gives up waiting. */
  signal?: AbortSignal;
}

/** What runs, and why. */
export interface Info {
  /** Threads that compute: 0 when the single-threaded build runs. */
  readonly threads: number;
  /** Always true: without SIMD the engine does not start. */
  readonly simd: boolean;
  /** Why this build runs, in words. */
  readonly reason: string;
  /** Of the package. */
  readonly version: string;
  /** Bytes of sources kept in JavaScript, from which a single-threaded engine is rebuilt after an abort. */
  readonly memory: number;
}

/** An engine: it opens files and arrays. */
export interface FastWinding extends VoxelFunctions {
  /** What runs, and why. */
  readonly info: Info;
  /** Reads a file of any known format: STL, OBJ, PLY, XYZ, OFF, 3MF, and what `save` gives. */
  open(bytes: Bytes, options?: ReadOptions & CallOptions): Promise<Soup | Cloud>;
  /** Reads what `save` gives, and nothing else. */
  load(bytes: Bytes, options?: { transfer?: boolean } & CallOptions): Promise<Soup | Cloud>;
  /** Makes soups. */
  readonly Soup: {
    /** Reads a file that must hold triangles. */
    parse(bytes: Bytes, options?: ReadOptions & CallOptions): Promise<Soup>;
    from(data: SoupArrays, options?: { transfer?: boolean }): Promise<Soup>;
  };
  /** Makes clouds. */
  readonly Cloud: {
    /** Reads a file that must hold points. */
    parse(bytes: Bytes, options?: ReadOptions & CallOptions): Promise<Cloud>;
    from(data: CloudArrays, options?: { orient?: 'auto'; transfer?: boolean }): Promise<Cloud>;
  };
  /** One layer as a file. */
  exportLayer(layer: Layer, format: 'svg'): Promise<Uint8Array>;
  /**
   * Layers as one file: `svg` with a group for each, as Slic3r writes it; `dxf`; `json`; or `3mf` with the slice extension, which
   * requires a `mesh` beside the slices, such as `geometry()` and `surface()` give.
   */
  exportLayers(
    layers: Layer[],
    format: 'svg' | 'dxf' | 'json' | '3mf',
    mesh?: { positions: Float32Array | Float64Array; indices: Uint32Array; origin?: Float64Array },
  ): Promise<Uint8Array>;
  /** The lines that fill layers, for a nozzle: walls, infill, skins, in the order they are laid. */
  toolpaths(layers: Layer[], settings?: ToolpathSettings & CallOptions): Promise<Toolpaths>;
  /** A program for a printer, G-code in Marlin's dialect. Fails with `DoesNotFit` if the print is too large for it or off its bed. */
  gcode(paths: Pick<Toolpaths, 'layers'>, profile?: PrinterProfile): Promise<GCode>;
  /**
   * Settings and a profile with all that is not given, as the defaults have it; fails if a value is out of range, and with
   * `DoesNotFit` if a model of the `size` (x, y, z) in millimetres is too large for the printer.
   */
  printSettings(given?: {
    settings?: ToolpathSettings;
    profile?: PrinterProfile;
    size?: [number, number, number];
  }): Promise<{ settings: Required<ToolpathSettings>; profile: RequiredProfile }>;
  /** Ends the engine: its worker, its threads, its shapes. */
  dispose(): void;
  /** As `dispose`, for `using`. */
  [Symbol.dispose](): void;
}
