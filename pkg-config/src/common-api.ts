// What many calls take and give, as the package's callers see it. Lengths are in millimetres.

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

/** The content of a file. */
export type Bytes = Uint8Array | ArrayBuffer;

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
