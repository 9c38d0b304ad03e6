// Voxels and saved fields, as the package's callers see them.
import type { CallOptions, Mesh, VoxelOptions, Voxels } from './api.js';

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

/** What a shape does beside {@link Voxels}. */
export interface VoxelShape {
  /** The voxels of `voxelize` in bricks. Memory grows with the surface, by `continuation`, and for soups by `lattice`. */
  voxelBricks(options?: Omit<VoxelOptions, 'format'>): Promise<VoxelBricks>;
  /** The shape and its field as bytes, which `open` and `load` make shapes of that need not be built again. */
  save(options?: CallOptions): Promise<Uint8Array>;
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
