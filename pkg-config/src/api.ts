import type { BooleanOperation, BooleanOptions, BooleanResult } from './boolean-api.js';
import type { CheckOptions, CheckReport, FaceOrientOptions, OrientedFaces } from './check-api.js';
import type { Distances, HollowOptions } from './distance-api.js';
import type { GCode, PrinterProfile, RequiredProfile, ToolpathSettings, Toolpaths } from './print-api.js';
import type { RemeshOptions, Repaired, RepairOptions } from './repair-api.js';
import type { TexturedSoup } from './texture-api.js';
import type { VoxelFunctions, VoxelMethodOptions, VoxelShape } from './voxels-api.js';
export type * from './boolean-api.js';
export type * from './check-api.js';
export type * from './distance-api.js';
export type * from './print-api.js';
export type * from './repair-api.js';
export type * from './texture-api.js';
export type * from './voxels-api.js';

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

/** Options of every call that may take long. */
export interface CallOptions {
  /** Stops the call, which then rejects with `Aborted`. Not heard by `./sync`. */
  signal?: AbortSignal;
  /** Hears of progress: a fraction in [0, 1] that never falls, and the stage's name. */
  onProgress?: (fraction: number, stage: string) => void;
}

/** How a file is read, and what becomes of its bytes. */
export interface ReadOptions {
  /** Unit of files that do not state theirs (STL, OBJ, PLY, XYZ, OFF). Everything becomes millimetres. */
  unit?: 'micron' | 'millimeter' | 'centimeter' | 'inch' | 'foot' | 'meter';
  /** Clouds without normals: estimate and orient them at once. */
  orient?: 'auto';
  /** Take over the input's buffer, which becomes unusable for the caller, rather than copy it. */
  transfer?: boolean;
}

/** Something in the input that was put right or left out: never a reason to refuse it. */
export interface Warning {
  /** Stable, for programs: for example `non-finite-faces`. */
  code: string;
  /** How many faces, points, records or bytes it concerns. */
  count: number;
  /** For people. */
  message: string;
}

/** An axis-aligned box, in millimetres. */
export interface Bounds {
  /** x, y and z. */
  min: [number, number, number];
  /** x, y and z. */
  max: [number, number, number];
}

/** A triangle mesh. */
export interface Mesh {
  /** xyzxyz… in millimetres, relative to `origin`. */
  positions: Float32Array;
  /** One unit vector for each position, outward. */
  normals: Float32Array;
  /** Three for each triangle, counter-clockwise seen from outside. */
  indices: Uint32Array;
  /** Three numbers to add to positions: zero unless the model lies far from the origin. */
  origin: Float64Array;
}

/** Rings are xyxy… in millimetres and do not repeat their first point. */
export interface Polygon {
  /** Counter-clockwise seen from +z. */
  outer: Float64Array;
  /** Clockwise seen from +z. */
  holes: Float64Array[];
}

/** One slice: the polygons of {w ≥ 1/2} at `zSample`. Heights in millimetres. */
export interface Layer {
  /** Where the layer begins. */
  zBottom: number;
  /** Where a printer's nozzle lays this layer. */
  zTop: number;
  /** Where the field was asked. */
  zSample: number;
  /** None where the plane meets nothing that is inside. */
  polygons: Polygon[];
}

/** The lattice fills the shape's bounds, samples at cell centres. One of resolution, spacing, counts. */
export interface VoxelOptions extends VoxelMethodOptions, CallOptions {
  /** Cells along the longest side; 64 unless said otherwise. */
  resolution?: number;
  /** Edge of a cubic cell in millimetres. */
  spacing?: number;
  /** Cells along x, y and z. */
  counts?: [number, number, number];
  /** A voxel is inside when w at its centre is at least this: 0.5 unless said otherwise. */
  threshold?: number;
  /** `bytes`: 0 or 1 for each voxel. `bits`: 8 voxels a byte, lowest bit first. */
  format?: 'bytes' | 'bits';
  /** Also return the exposed faces as a mesh. */
  surface?: boolean;
}

/** Which cells of a lattice are inside. */
export interface Voxels {
  /** Cells along x, y and z. */
  counts: [number, number, number];
  /** Centre of the first voxel. */
  origin: [number, number, number];
  /** Edges of a voxel along x, y and z, in millimetres. */
  spacing: [number, number, number];
  /** x fastest. */
  inside: Uint8Array;
  /** Number of voxels inside. */
  count: number;
  /** Cubic millimetres inside. */
  volume: number;
  /** The faces between inside and outside, if they were asked for. */
  surface?: Mesh;
}

/** Layers of equal height from the bottom of the shape, or those at `heights`. */
export interface SliceOptions extends CallOptions {
  /** Millimetres: 0.2 unless said otherwise. */
  layerHeight?: number;
  /** Millimetres: as the others unless said otherwise. */
  firstLayerHeight?: number;
  /** Where in its span a layer is sampled: `middle` unless said otherwise. */
  sampleAt?: 'bottom' | 'middle' | 'top';
  /**
   * Layers as thick as slopes allow, in place of `layerHeight`: from `least` to `most`, so that their steps stand off the surface by
   * `deviation` at most; horizontal faces become boundaries of layers. All in millimetres.
   */
  adaptive?: { least: number; most: number; deviation: number };
  /** Heights z to sample instead, in millimetres. */
  heights?: number[] | Float64Array;
  /**
   * What is inside: `winding`, w ≥ 1/2, unless said otherwise; `even-odd`, where w rounded is odd, so that overlaps are left out; or
   * `largest`, the largest outline without its holes, for a vase.
   */
  mode?: 'winding' | 'even-odd' | 'largest';
  /** Vertices are left out where contours stay this near, in millimetres, and hang together as they do: 0 unless said otherwise. */
  simplify?: number;
  /** Of clouds: edge of a cell in the plane, in millimetres: features smaller than it may be missed. Soups have exact contours. */
  tolerance?: number;
  /** Of clouds: cells along the longest side when `tolerance` is not given: 256 unless said otherwise. */
  resolution?: number;
}

export interface SurfaceOptions extends CallOptions {
  /** Cells along the longest side. Without it and `spacing` soups get 64, clouds cells as large as their points' distances allow. */
  resolution?: number;
  /** Edge of a cubic cell in millimetres. */
  spacing?: number;
  /** The surface is where w equals this: unless said otherwise 0.5 for soups, and for clouds what passes through their points. */
  level?: number;
  /** Pieces with less than this share of the largest one's area are left out: 0 keeps all. Clouds lose tiny ones unless it is said. */
  minComponent?: number;
  /** For noisy clouds: points act as Gaussians of this many mean distances between points, such as 1. */
  smoothing?: number;
  /** For open scans: surface farther from any point of the cloud than this many distances between points is left out; then it is open. */
  trim?: number;
  /** Degrees between two parts of the surface from which the edge between them is kept sharp, such as 35: 10 to 120. Without it cells cut off edges and corners. */
  sharp?: number;
}

/** w over a plane z = constant, a little beyond the bounds. */
export interface HeatMap {
  /** Samples along x and y. */
  counts: [number, number];
  /** The first sample. */
  origin: [number, number];
  /** Millimetres from sample to sample along x and y. */
  spacing: [number, number];
  /** Millimetres. */
  z: number;
  /** x fastest. */
  values: Float64Array;
}

/** How exact winding numbers are: a tolerance, or the order and opening distance of the expansion. */
export interface Accuracy {
  /** Largest error of w: 1e-3 unless said otherwise; 0 means exact to rounding. */
  tolerance?: number;
  /** Order of the expansion. */
  order?: 0 | 1 | 2;
  /** A node is expanded beyond `beta` times its radius: 2 for soups, 2.3 for clouds unless said otherwise. */
  beta?: number;
}

/** What a built tree is. */
export interface Prepared {
  /** How long it took. */
  milliseconds: number;
  /** Memory that it takes beside the shape. */
  bytes: number;
  /** How winding numbers are computed, in words. */
  method: string;
  /** Pieces of the surface that are connected. */
  components: number;
  /** Edges where the surface is open. */
  boundaryEdges: number;
  /** Triangles that close the openings. */
  caps: number;
}

/** Formats of triangles that are written. */
export type SoupFormat = 'stl' | 'obj' | 'ply' | 'off' | '3mf';
/** Formats of points that are written. */
export type CloudFormat = 'ply' | 'xyz';

/** What a soup and a cloud have in common: a winding field, and questions to it. */
export interface Shape extends VoxelShape, Distances {
  /** Triangles or points. */
  readonly kind: 'soup' | 'cloud';
  /** The file's format, `arrays`, or `field` if it was saved. */
  readonly format: string;
  /** What was put right or left out when it was read. */
  readonly warnings: Warning[];
  /** The smallest box around it. */
  readonly bounds: Bounds;
  /** Number of triangles or points. */
  readonly count: number;
  /** Gives its memory back at once; later calls fail with `Freed`. */
  free(): void;
  /** As `free`, for `using`. */
  [Symbol.dispose](): void;
  /**
   * Builds the tree ahead of time. `bounded`, for clouds, for this and all later calls: no point adds more than ½ to the winding
   * number (*Leaps and Bounds*), which stays smooth right next to noisy points; off unless asked for.
   */
  prepare(options?: Accuracy & { leafSize?: number; bounded?: boolean } & CallOptions): Promise<Prepared>;
  /** Winding numbers at `points` (xyzxyz…), one for each. */
  windingNumbers(points: Float32Array | Float64Array, options?: Accuracy & CallOptions): Promise<Float64Array>;
  /** 1 for each of `points` (xyzxyz…) that is inside, else 0. */
  contains(points: Float32Array | Float64Array, options?: CallOptions): Promise<Uint8Array>;
  /** Which cells of a lattice are inside. */
  voxelize(options?: VoxelOptions): Promise<Voxels>;
  /** Contours of layers, from the lowest up. */
  slice(options?: SliceOptions): Promise<Layer[]>;
  /** The same layers one after the other, from the first: only some are in memory at a time. */
  layers(options?: SliceOptions): AsyncIterable<Layer>;
  /** The surface where w = 1/2, closed unless it is trimmed. */
  surface(options?: SurfaceOptions): Promise<Mesh>;
  /** w over the plane at `z` millimetres, `resolution` samples along the longer side. */
  heatMap(options: { z: number; resolution?: number } & CallOptions): Promise<HeatMap>;
  /**
   * The solids of this shape and another combined: each trimmed along the other's surface, exactly, and where that is missing along the
   * level set of its field. Of closed soups the result is closed; what nothing cuts stays as it is.
   */
  boolean(operation: BooleanOperation, other: Shape, options?: BooleanOptions): Promise<BooleanResult>;
  /** The shape as a file: `stl` (binary), `obj`, `ply`, `off` or `3mf` for soups, `ply` or `xyz` for clouds. */
  export(format: SoupFormat | CloudFormat): Promise<Uint8Array>;
}

/** Triangles without any promise about how they fit together. */
export interface Soup extends Shape, TexturedSoup {
  readonly kind: 'soup';
  /** The triangles as they are. */
  geometry(): Promise<{ positions: Float32Array; indices: Uint32Array; origin: Float64Array }>;
  /** The walls along its inside, less the drains: closed and manifold. Fails with `EmptyResult` where they leave no cavity. */
  hollow(options: HollowOptions): Promise<Mesh>;
  /** Where the surface is open: two ends (xyzxyz) for each of `count` edges. */
  boundaryEdges(): Promise<{ positions: Float32Array; origin: Float64Array; count: number }>;
  /** What is wrong with it, what the winding field makes of it, and whether it will print. */
  check(options?: CheckOptions): Promise<CheckReport>;
  /**
   * Turns faces so that they run with their neighbours and face outward. Cavities stay cavities as far as that can be told. Later
   * calls are about the soup as it is then.
   */
  orient(options?: FaceOrientOptions): Promise<OrientedFaces>;
  /**
   * Points with normals and areas of the mesh: its vertices (the default), each with a third of the triangles around it, or the
   * barycentres of its triangles. What has no area or direction is left out, with a warning.
   */
  toCloud(options?: { at?: 'vertices' | 'barycentres' } & CallOptions): Promise<Cloud>;
  /** A closed manifold that bounds where w ≥ ½, with the triangles of this soup, or made anew. This soup stays as it is. */
  repair(options?: RepairOptions): Promise<Repaired<Soup>>;
}

export interface OrientOptions extends CallOptions {
  /**
   * `consistency` (the default) seeks the normals whose winding number is ½ at every point (Lin et al. 2024); `stochastic` those
   * that make it 0 or 1 everywhere else (the sGCNO of *Leaps and Bounds*), some twenty times slower, better where noise is strong
   * and points are few; `propagation` fits planes to neighbours and turns one after the other, faster, but thin or sparse parts
   * may come out inverted.
   */
  method?: 'consistency' | 'stochastic' | 'propagation';
  /** Of `consistency`: 0 to 5, estimated unless given. Higher smooths more. */
  noiseLevel?: number;
  /** Sees the normals (xyzxyz…, some may be 0) some times a second while `consistency` lets them settle. */
  onNormals?: (normals: Float32Array) => void;
}

/** Points, perhaps with normals and areas. */
export interface Cloud extends Shape {
  readonly kind: 'cloud';
  /** Whether each point has a normal, given or found. */
  readonly hasNormals: boolean;
  /** Whether each point has an area, given or estimated. */
  readonly hasAreas: boolean;
  /** Gives points without normals outward ones, and areas. */
  orient(options?: OrientOptions): Promise<void>;
  /** Noise around each point, in millimetres: how far it and its neighbours are from a smooth surface, root mean square. */
  noise(options?: CallOptions): Promise<Float64Array>;
  /** A closed manifold that bounds where w ≥ ½. */
  repair(options?: RemeshOptions): Promise<Repaired<Soup>>;
  /** The points as they are; areas in square millimetres. */
  geometry(): Promise<{
    positions: Float32Array;
    normals?: Float32Array;
    areas?: Float64Array;
    origin: Float64Array;
  }>;
}

/** The content of a file. */
export type Bytes = Uint8Array | ArrayBuffer;

/** Triangles as arrays. */
export interface SoupArrays {
  /** xyzxyz… in millimetres. */
  positions: Float32Array | Float64Array;
  /** Three for each triangle, counter-clockwise seen from outside; without them each three positions are one. */
  indices?: Uint32Array;
}

/** Points as arrays. */
export interface CloudArrays {
  /** xyzxyz… in millimetres. */
  points: Float32Array | Float64Array;
  /** xyzxyz…, outward; any length but zero. */
  normals?: Float32Array | Float64Array;
  /** Square millimetres, one for each point; estimated where missing. */
  areas?: Float32Array | Float64Array;
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
