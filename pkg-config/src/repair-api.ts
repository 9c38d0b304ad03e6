// Repaired meshes, as the package's callers see them. Lengths are in millimetres, angles in degrees.
import type { CheckReport } from './check-api.js';
import type { CallOptions } from './common-api.js';

/** How a surface is made anew. */
export interface RemeshOptions extends CallOptions {
  /** Of soups `conserve` unless given; clouds are always made anew. */
  method?: 'remesh';
  /** Cells along the longest side; used when `spacing` is not given. Without either they are as large as the model's median edge is long. */
  resolution?: number;
  /** Edge of a cell. */
  spacing?: number;
  /** From which angle edges stay sharp; 35 unless given, 0 for none. */
  sharp?: number;
  /** Pieces with less than this share of the largest one's area are left out. */
  minComponent?: number;
  /** Whether the shape is checked before and after (the default). */
  check?: boolean;
}

/** How a soup is repaired. */
export interface RepairOptions extends Omit<RemeshOptions, 'method'> {
  /**
   * `conserve` (the default) keeps the soup's triangles: drops duplicates and what bounds nothing, turns, stitches, closes openings,
   * splits what intersects; `remesh` makes the surface anew.
   */
  method?: 'conserve' | 'remesh';
  /** Of `conserve`: open edges no farther apart are stitched; unless given, 1e-5 of the diagonal, and up to 1e-3 if need be. */
  tolerance?: number;
  /** Of `conserve`: whether triangles are turned over where neighbours disagree; they are unless told otherwise. */
  orient?: boolean;
  /** Of `conserve`: the least `report.agreement`, 0.8 unless given, below which the surface is made anew. */
  leastAgreement?: number;
  /** Of `conserve`: whether the surface is made anew where the triangles do not suffice (the default). The report says if it was. */
  fallback?: boolean;
}

/** What a repair has changed, and what came of it. Numbers are of triangles if they do not say otherwise. */
export interface RepairReport {
  /** How it was repaired at last. */
  method: 'conserve' | 'remesh';
  /** Within which open edges were stitched. */
  tolerance: number;
  /** Dropped, as another has the same corners. */
  duplicates: number;
  /** Dropped in pairs of opposite orientation. */
  cancelled: number;
  /** Dropped for want of an area. */
  degenerate: number;
  /** Vertices of open edges welded to others within the tolerance. */
  stitchedVertices: number;
  /** Vertices within the tolerance of another's open edge, which was split there. */
  splitEdges: number;
  /** Turned over. */
  flipped: number;
  /** Cycles of boundary edges closed by caps, the triangles of these, and square millimetres. */
  holes: number;
  /** See `holes`. */
  capTriangles: number;
  /** See `holes`. */
  capArea: number;
  /** Of the largest cap, in square millimetres. */
  largestCapArea: number;
  /** Those that others cut, into how many parts, and those that still cross as coordinates are rounded. */
  intersecting: number;
  /** See `intersecting`. */
  parts: number;
  /** See `intersecting`. */
  unresolved: number;
  /** Dropped, as the inside is on both sides; or on neither. */
  internal: number;
  /** See `internal`. */
  outside: number;
  /** Pieces without thickness, dropped. */
  sheets: number;
  /** Vertices put in the place of others, where the surface touched itself. */
  separatedVertices: number;
  /** Of the result: triangles of the input or parts of them, and new ones. */
  kept: number;
  /** See `kept`. */
  new: number;
  /** Whether each edge of the result has two triangles, which run through it in opposite directions. */
  closed: boolean;
  /** Cubic millimetres in the result. */
  volume: number;
  /** Of all places that are inside of the result or have w ≥ ½, the share that is both, on a lattice. */
  agreement: number;
  /**
   * Why the surface was made anew though its triangles were to be kept: closed, they bound another solid than w ≥ ½, as where gaps are
   * between parts that belong together; nothing; or they could not be closed.
   */
  fallback?: 'disagrees' | 'empty' | 'open';
  /** How far from the soup a surface made anew is. */
  distances?: {
    /** Edge of a cell. */
    spacing: number;
    /** Share of the vertices on the soup, to a thousandth of a cell. */
    onInput: number;
    /** From vertices that are nearer to it than a cell. */
    meanToInput: number;
    mostToInput: number;
    /** From places on triangles of the soup that have w ≥ ½ on one side alone; `p99`: 99 % are nearer. */
    meanFromInput: number;
    p99FromInput: number;
    mostFromInput: number;
  };
}

/** A repaired shape, and what was done. */
export interface Repaired<Soup> {
  /** A shape of its own, to be asked, exported and freed like any other. */
  soup: Soup;
  /** What was done. */
  report: RepairReport;
  /** Of each triangle, the one of the input that it is or is a part of, 4294967295 for new ones; empty if all are new. */
  sources: Uint32Array;
  /** What `check` says of the soup, and of the result; absent if not wanted, the first for clouds too. */
  before?: CheckReport;
  /** See `before`. */
  after?: CheckReport;
}
