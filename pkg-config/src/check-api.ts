// Checks of soups and the turning of their faces, as the package's callers see them. Lengths are in millimetres, angles in degrees;
// faces and vertices are named by their number in the soup, vertices in one place by the lowest of theirs.
import type { Bounds, CallOptions } from './common-api.js';

export interface CheckOptions extends CallOptions {
  /** Most entries of each list of defects (10,000); the count beside a list is the true one. */
  limit?: number;
  /** A face is a sliver if its least height is below this share of its longest side (0.01). */
  sliverRatio?: number;
  /** Whether pairs of faces that go through each other are looked for (true). */
  selfIntersections?: boolean;
  /** Points on the surface at which the field and the thickness are taken, by area (10,000); each face has at least one. */
  samples?: number;
  /** Whether rays measure how thick the solid is (true). */
  thickness?: boolean;
  /** Faces with a thickness below this are listed (0.8). */
  minimumThickness?: number;
  /** Faces that lean out by more than this from the vertical are overhangs (50); 90 for none. */
  overhangAngle?: number;
  /** Width, depth and height of the space that the model is to fit in. */
  bed?: [number, number, number];
  /** Cells along the longest side of the lattice that the volume is judged by (48); 0 leaves that out. */
  resolution?: number;
}

/** Numbers of faces or vertices. */
export interface Indices {
  /** How many there are; `list` may hold fewer. */
  count: number;
  /** Their numbers. */
  list: Uint32Array;
}

/** Pairs: the two vertices of an edge, or two faces. */
export interface IndexPairs {
  /** How many pairs there are; `list` may hold fewer. */
  count: number;
  /** Two numbers for each pair. */
  list: Uint32Array;
}

/** Open edges around a hole, or to where more than two faces meet. */
export interface BoundaryLoop {
  /** How many edges it has. */
  edges: number;
  /** Of all of them. */
  length: number;
  /** That of a flat hole; a slit has none. */
  area: number;
  /** Whether it comes back to where it began. */
  isClosed: boolean;
  /** In their order along the hole, as many as `limit` lets through. */
  vertices: Uint32Array;
}

/** Faces that hang together by edges of two faces. */
export interface Shell {
  /** The lowest of its faces. */
  firstFace: number;
  /** How many. */
  faces: number;
  /** Square millimetres. */
  area: number;
  /** Whether each edge has two faces. */
  isClosed: boolean;
  /** Whether it has two sides. */
  isOrientable: boolean;
  /** What a closed one encloses; negative if its faces are turned inward. */
  volume?: number;
  /** Vertices less edges plus faces. */
  eulerNumber: number;
  /** Handles of a closed one with two sides. */
  genus?: number;
  /** How many closed shells a closed one is in. */
  depth?: number;
  /**
   * What it is in the solid, by most of its area: it bounds it; bounds it with its faces turned inward; lies inside; is inside
   * out; or bounds nothing.
   */
  role: 'boundary' | 'reversed' | 'internal' | 'inverted' | 'outside';
}

/** Cells that hang together in which w is what it is not around a clean solid. */
export interface FieldRegion {
  /** 0.1 < w < 0.9; w ≥ 1.9; or w ≤ −0.9. */
  kind: 'ambiguous' | 'overlap' | 'inverted';
  /** Cubic millimetres. */
  volume: number;
  /** Around it. */
  bounds: Bounds;
  /** Least and greatest w in the middles of its cells. */
  least: number;
  /** See `least`. */
  greatest: number;
}

/** What speaks against a print, or would be better otherwise. */
export type ReasonKind =
  | 'noSolid' | 'doesNotFit' | 'flippedFaces' | 'ambiguous' | 'holes' | 'inverted' | 'internalFaces' | 'overlaps' | 'outsideFaces'
  | 'selfIntersections' | 'nonManifold' | 'duplicateFaces' | 'degenerateFaces' | 'thin' | 'overhangs';

/** What `check` finds. */
export interface CheckReport {
  /** Whether it will print, in words, with the reasons, the weightiest first. */
  verdict: {
    rating: 'clean' | 'printsAsSeen' | 'doubtful' | 'noSolid';
    text: string;
    reasons: { kind: ReasonKind; count: number; text: string }[];
  };
  /** All of the soup. */
  triangles: number;
  /** Different places of corners. */
  vertices: number;
  /** Vertices of no triangle. */
  unusedVertices: number;
  /** Here and below: of the faces without copies and without those with two corners in one place. */
  edges: number;
  /** Around all triangles. */
  bounds: Bounds;
  /** Whether it fits, as it is or turned about z, if a size was given. */
  bed?: { size: [number, number, number]; fits: boolean; fitsTurned: boolean };
  /** Of all faces, in square millimetres. */
  area: number;
  /** What the faces enclose, as often as they do. */
  volume: number;
  /** Faces with the corners of an earlier one, turning the same way. */
  duplicateFaces: Indices;
  /** Faces without an area. */
  degenerateFaces: Indices;
  /** Long thin faces, by `sliverRatio`. */
  sliverFaces: Indices;
  /** Edges of one face, and the holes they go around, the longest first. */
  boundary: { edges: number; length: number; loops: { count: number; list: BoundaryLoop[] } };
  /** Edges of more than two faces. */
  nonManifoldEdges: IndexPairs;
  /** Vertices whose faces do not make one fan. */
  nonManifoldVertices: Indices;
  /** Edges whose two faces run along them in the same direction: one is flipped. */
  inconsistentEdges: IndexPairs;
  /** Pieces that share no vertex. */
  components: number;
  /** The largest area first. */
  shells: { count: number; list: Shell[] };
  /** How many shells are closed. */
  closedShells: number;
  /** Closed shells in others. */
  nestedShells: number;
  /** Shells that are inside out. */
  invertedShells: number;
  /** Pairs of faces whose insides have a point in common. */
  selfIntersections?: IndexPairs;
  /** Vertices less edges plus faces, of all shells. */
  eulerNumber: number;
  /** Handles of all shells together, if all are closed and have two sides. */
  genus?: number;
  /** Faces to turn, and the shells that have such. */
  flippedFaces: Indices;
  /** Shells with faces to turn. */
  flippedShells: number;
  /** Faces both of whose sides are inside, and those both of whose sides are outside. */
  internalFaces: Indices;
  /** See `internalFaces`. */
  outsideFaces: Indices;
  /** Where w is what it is not around a clean solid, by cells over the bounds, halved where they differ from those beside them. */
  field?: {
    /** Edge of a cell. */
    cell: number;
    /** Of the lattice’s box, in cubic millimetres. */
    boxVolume: number;
    /** Volume with w ≥ 1/2. */
    solidVolume: number;
    /** Volume with 0.1 < w < 0.9, and its share of the box. */
    ambiguousVolume: number;
    ambiguousShare: number;
    /** Volume with w ≥ 1.9, and with w ≤ −0.9. */
    overlapVolume: number;
    invertedVolume: number;
    /** The largest first. */
    regions: { count: number; list: FieldRegion[] };
  };
  /** How far it is from points of the surface, straight into the solid, to where that ends. */
  thickness?: {
    /** Points from which rays were sent. */
    samples: number;
    /** Points from which a ray left through an opening. */
    unbounded: number;
    /** The least that was found, on which face, and where. */
    minimum: number;
    thinnestFace: number;
    thinnestPoint: [number, number, number];
    /** `[share of the area in percent, thickness that so much of it does not exceed]`. */
    percentiles: [number, number][];
    /** `minimumThickness`, the faces below it, and their area in square millimetres. */
    threshold: number;
    thinFaces: Indices;
    thinArea: number;
  };
  /** Faces of the solid that hang over. */
  overhangs: {
    /** `overhangAngle`, the faces beyond it, and their area in square millimetres. */
    angle: number;
    area: number;
    faces: Indices;
    /** `[angle, area of the faces that lean out by more]`, every 5 degrees. */
    byAngle: [number, number][];
  };
}

export interface FaceOrientOptions extends CallOptions {
  /**
   * How pieces are turned that are not closed: by the `parity` of the faces that rays cross (the default), by how far they get
   * (`visibility`), or by the normals that make the winding number of the faces' middles consistent with itself (`consistency`).
   */
  method?: 'parity' | 'visibility' | 'consistency';
  /** Rays from each piece at most (128). */
  rays?: number;
}

/** What `orient` has done to a soup. */
export interface OrientedFaces {
  /** Faces whose corners run the other way now, ascending. */
  flipped: Uint32Array;
  /** Pieces that were turned as a whole, those of them that are closed, and those that have no two sides. */
  patches: number;
  /** See `patches`. */
  closedPatches: number;
  /** See `patches`. */
  oneSidedPatches: number;
  /** How, in words. */
  method: string;
}
