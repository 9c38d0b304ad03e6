// Voxels, as the package's callers see them.
import type { CallOptions, Mesh } from './common-api.js';

/**
 * How it is found out what is inside. `lattice`, which is also called `exact`, asks every cell; `continuation` follows the surface from
 * the cells that hold geometry. The others are for comparison: `rays` counts crossings along rows of the lattice, of soups alone; `fast`
 * takes w as the evaluator of Barill et al. 2018 approximates it; `cloud` puts points in the place of a soup's triangles.
 */
export type VoxelMethod = 'lattice' | 'exact' | 'continuation' | 'rays' | 'fast' | 'cloud';

/** How it is found out what is inside. */
export interface VoxelMethodOptions {
  /** `lattice` unless said otherwise. */
  method?: VoxelMethod;
  /**
   * Of `rays`: inside is an odd number of crossings, `parity`, unless said otherwise, or as many `signed` ones as the threshold; by rays
   * along −x, or by two of three along all axes.
   */
  rays?: { count?: 'parity' | 'signed'; majority?: boolean };
  /** Of `fast`: 2 unless said otherwise. */
  order?: 0 | 1 | 2;
  /** Of `fast`: 2 for soups, 2.3 for clouds unless said otherwise. */
  beta?: number;
  /** Of `cloud`: `vertices` unless said otherwise. */
  points?: 'vertices' | 'barycentres';
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

/** Cells of a lattice in bricks of 8 × 8 × 8, for resolutions at which a byte or a bit for each is too much. */
export interface VoxelBricks extends Omit<Voxels, 'inside'> {
  /** The cells. */
  bricks: {
    /** Bricks that hold cells of both kinds: their places in the lattice of bricks, ⌈counts / 8⌉ along each axis, x fastest, which rise. */
    mixed: Uint32Array;
    /** 64 bytes for each of these, 8 voxels a byte, lowest bit first, x fastest. */
    bits: Uint8Array;
    /** Bricks that are inside all through. */
    full: Uint32Array;
  };
}

/** In which cells two sets differ. */
export interface VoxelDifference {
  /** Places, x fastest, of voxels inside the first but not the second. */
  lost: Uint32Array;
  /** Of those inside the second but not the first. */
  gained: Uint32Array;
  /** Of both. */
  count: number;
  /** Of the insides, from 0 to 1. */
  intersectionOverUnion: number;
}

/** How voxels are written. */
export interface VoxelExportOptions {
  /** Of `vox`: all voxels inside, not those alone that can be seen. */
  solid?: boolean;
  /** Of `nrrd`: without compression. */
  raw?: boolean;
}

/** What is done with voxels. */
export interface VoxelFunctions {
  /** The faces between inside and outside. */
  voxelSurface(voxels: Voxels | VoxelBricks): Promise<Mesh>;
  /** Which voxels of two sets differ, which must be of one lattice. */
  compareVoxels(first: Voxels | VoxelBricks, second: Voxels | VoxelBricks): Promise<VoxelDifference>;
  /**
   * `vox` as MagicaVoxel reads it, in models of up to 256 voxels along each side; `nrrd` as Slicer, ITK and others do, with places in
   * millimetres.
   */
  exportVoxels(voxels: Voxels | VoxelBricks, format: 'vox' | 'nrrd', options?: VoxelExportOptions): Promise<Uint8Array>;
}
