// Textures of soups, as the package's callers see them. Lengths are in millimetres; texture coordinates go from 0 to 1, v upward.
import type { CallOptions, Warning } from './common-api.js';

/** The proxy: a closed mesh at a distance from the soup, whose texture the soup gets. */
export interface ProxyOptions {
  /** Distance from the soup: 3 % of the longest side of its bounds unless said otherwise. See `suggestOffset`. */
  offset?: number;
  /** Samples along the longest side: two for each offset unless said otherwise, 400 at most. Fewer than two give a warning. */
  resolution?: number;
  /**
   * `outer` (the default) is the surface at the signed distance, where openings that the soup surrounds are closed; `both` the one at the
   * distance without a sign, which passes through openings wider than two offsets.
   */
  sides?: 'outer' | 'both';
  /** Rounds of Laplacian smoothing, which takes off steps and shrinks what is curved a little: none unless said otherwise. */
  smoothing?: number;
}

/** The atlas: charts of the proxy, which are laid flat and packed into a square. */
export interface AtlasOptions {
  /** Degrees that triangles of a chart may face away from its axis, 10 to 80: 60 unless said otherwise. */
  cone?: number;
  /** Chains of vertices of the proxy, such as `seam` gives, that no chart reaches across. */
  seams?: ArrayLike<number>[];
  /** Whether charts are made by these seams alone, and cut further only where one is no disk or overlaps itself. */
  onlySeams?: boolean;
  /** Side of the texture in texels, 16 to 65,536, in which the margin is measured: 2048 unless said otherwise. */
  texels?: number;
  /** Texels between two charts: 8 unless said otherwise. */
  margin?: number;
  /** Rounds in which the distortion of charts is lowered: 12 unless said otherwise. */
  rounds?: number;
}

export interface TextureOptions extends ProxyOptions, AtlasOptions, CallOptions {
  /** Whether triangles are first split where they run through each other. */
  refine?: boolean;
  /** How charges are found: `krylov` (GMRES) unless said otherwise, or by exchanges as in the paper. */
  solver?: 'krylov' | 'robin-hood';
  /** Largest deviation of the potential on the soup from its mean, relative to that: 1e-6 unless said otherwise. */
  tolerance?: number;
  /** How a line is followed: `midpoint` unless said otherwise. */
  integrator?: 'midpoint' | 'euler';
  /** Steps of a line, at least: 100 unless said otherwise. */
  steps?: number;
  /** Length of a step. Unless said otherwise, all steps lead a tenth of the diagonal away, or four offsets if that is farther. */
  step?: number;
  /** How far off the soup a line first asks for the field: a tenth of a step unless said otherwise. */
  startOffset?: number;
  /** Steps are shortened where the field turns by more degrees than this from one to the next. */
  largestTurn?: number;
}

/** How a map from space into the plane distorts, over the triangles with an area, weighed by it. */
export interface Distortion {
  /** Mean and largest ratio of the larger singular value to the smaller: 1 where angles are kept. */
  meanRatio: number;
  /** See `meanRatio`. */
  largestRatio: number;
  /** Standard deviation of the natural logarithm of the ratio of areas: 0 where all are scaled alike. */
  areaSpread: number;
  /** Triangles that are flipped, and that have no area in the plane. */
  flipped: number;
  /** See `flipped`. */
  flat: number;
  /** Triangles with an area in space. */
  triangles: number;
}

/** What became of the soup's triangles. */
export interface MappingReport {
  /** Of the soup. */
  triangles: number;
  /** Those whose corners meet different charts, and of these those put into one of them by its closest points. */
  acrossCharts: number;
  /** See `acrossCharts`. */
  moved: number;
  /** Those that were flipped, or flat, before anything was moved, within one chart. */
  folded: number;
  /** Those that were more than 8 times as long as wide, or as large or small as they should be, before, within one chart. */
  squashed: number;
  /**
   * Those that were laid into a chart as they are in space, as they were flipped, flat or squashed otherwise; they may reach beyond it, but
   * not beyond the texture.
   */
  unfolded: number;
  /** Those that are flipped at last, or flat. */
  flipped: number;
  /** Those that are more than 8 times as large as they should be at last, or as small. */
  torn: number;
  /** Starts of lines that meet no proxy, which take its nearest point; and lines from a boundary that were replaced by straight ones. */
  lostLines: number;
  /** See `lostLines`. */
  tangentialLines: number;
  /** Triangles in narrow places, where the field is weak, whose lines do not lead out of them well: a smaller offset helps there. */
  weakField: number;
  /** Of the soup’s texture. */
  distortion: Distortion;
}

/** Where a texture is cut. */
export interface TextureSeams {
  /** Parts within which it is continuous: each loose triangle is one. */
  pieces: number;
  /** Of edges on whose two sides it differs. */
  length: number;
}

/** What came of the stages. */
export interface TextureReport {
  /** Of the proxy from the soup. */
  offset: number;
  /** Triangles of the proxy. */
  proxyTriangles: number;
  /** Pieces of the proxy: more than one where gaps between parts of the soup are wider than two offsets. */
  proxyComponents: number;
  /** Pieces of the atlas. */
  charts: number;
  /** Of all seams of the proxy, each counted once. */
  seamLength: number;
  /** Share of the texture that charts cover. */
  coverage: number;
  /** Of the atlas. */
  proxyDistortion: Distortion;
  /** Where the texture of the soup is cut. */
  seams: TextureSeams;
  /** One for each vertex of the soup and side that its triangles show there. */
  lines: number;
  /** What became of the soup’s triangles. */
  mapping: MappingReport;
  /** Codes such as `coarse-proxy`, `several-proxies`, `lost-lines`, `tangential-lines`, `weak-field`, `bad-texture`. */
  warnings: Warning[];
}

/** The soup that has the texture. */
export interface TexturedGeometry {
  /** xyzxyz…, as the soup has them. */
  positions: Float64Array;
  /** Three for each triangle. */
  indices: Uint32Array;
  /** u and v of the corners of each triangle: six numbers. Corners in one place may differ, so they are not those of positions. */
  uvs: Float32Array;
  /** The chart that each triangle is in. */
  charts: Uint32Array;
  /** If it was refined: of each triangle, the one of the soup that it is a part of. Empty otherwise. */
  sources: Uint32Array;
}

/** Triangles that did not simply go where their lines meet the proxy: lists of their numbers, ascending, in the soup that has the texture. */
export interface AffectedTriangles {
  /** Their corners meet different charts; of these those put into one of them by its closest points. */
  across: Uint32Array;
  moved: Uint32Array;
  /** Flipped or flat where their lines meet one chart, or squashed there: 8 times as long as wide, or as large or small as they should be. */
  folded: Uint32Array;
  squashed: Uint32Array;
  /** Laid into a chart as they are in space, as they were folded, squashed or torn. */
  unfolded: Uint32Array;
  /** Flipped or flat at last, and 8 times as large or small as they should be at last. */
  flipped: Uint32Array;
  torn: Uint32Array;
  /** With a corner whose line meets no proxy, and with one whose line was replaced as it ran along the surface. */
  lost: Uint32Array;
  tangential: Uint32Array;
  /** In narrow places that their lines do not lead out of well. */
  weak: Uint32Array;
}

/** How a soup is projected: along the shortest side of its bounds, each triangle along the axis that it faces, or onto a shape around the longest side. */
export type Projection = 'planar' | 'triplanar' | 'cylindrical' | 'spherical';

/** Texture coordinates by a projection. */
export interface Projected {
  /** u and v of the corners of each triangle: six numbers, from 0 to 1. Triangles may lie over each other. */
  uvs: Float32Array;
  /** Texture coordinates for a millimetre. */
  scale: number;
  /** How long a full turn is in u, if it goes round. */
  turn: number | undefined;
  distortion: Distortion;
  seams: TextureSeams;
}

/** The proxy with its atlas. */
export interface ProxyGeometry {
  /** xyzxyz… */
  positions: Float64Array;
  /** Three for each triangle, counter-clockwise seen from outside. */
  indices: Uint32Array;
  /** u and v of the corners of each triangle: six numbers. */
  uvs: Float32Array;
  /** The chart of each triangle. */
  charts: Uint32Array;
  /** Two vertices for each edge that is a seam, the lower first: between charts, or within one that was cut open. */
  seams: Uint32Array;
}

/** Polylines: points of line i are those from `offsets[i]` to `offsets[i + 1]`. */
export interface FieldLines {
  /** xyzxyz… */
  points: Float64Array;
  /** One more than lines. */
  offsets: Uint32Array;
}

/** A textured soup, with its proxy and its field lines. It does not change with the soup, and is freed by itself. */
export interface Texture {
  /** What came of it; another one after `remap`. */
  readonly report: TextureReport;
  /** The soup with its texture coordinates. */
  geometry(): Promise<TexturedGeometry>;
  /** The proxy with its charts and seams. */
  proxy(): Promise<ProxyGeometry>;
  /** Which triangles are moved, laid flat, torn, or in narrow places, for a list of them or to colour them. */
  affected(): Promise<AffectedTriangles>;
  /**
   * Field lines from the soup to where they meet the proxy first, `count` of them at most, spread evenly over the soup, or all. Those that
   * meet none are whole.
   */
  lines(options?: { count?: number }): Promise<FieldLines>;
  /**
   * The way along edges of the proxy from one vertex to the next, and on, that is cheapest by length and by how little the proxy bends
   * (section 6 of the paper): the chain of its vertices. No edge is used twice. For `seams`.
   */
  seam(from: number, to: number, ...further: number[]): Promise<Uint32Array>;
  /**
   * Anything that the proxy's vertices have, three numbers each, such as colours or normals: as the corners of the soup's triangles get it,
   * nine numbers for each triangle.
   */
  transfer(values: Float32Array | Float64Array): Promise<Float64Array>;
  /**
   * Takes another proxy, or another atlas of the same, for the same lines, which cost the most; this is the texture then. What is not given
   * stays as it was, but for seams: another proxy begins without, unless they are given. Lines made for a much smaller offset may end
   * before they meet the proxy, of which `lost-lines` warns. If it fails or is aborted the texture stays.
   */
  remap(options?: ProxyOptions & AtlasOptions & CallOptions): Promise<TextureReport>;
  /** The soup as Wavefront OBJ, and its material `NAME.mtl`, which shows the picture `image`, `NAME.png` unless given. */
  export(format: 'obj', options?: { name?: string; image?: string }): Promise<{ obj: Uint8Array; mtl: Uint8Array }>;
  /** Gives its memory back at once; later calls fail with `Freed`. */
  free(): void;
  /** As `free`, for `using`. */
  [Symbol.dispose](): void;
}

/** What a soup does about textures. */
export interface TexturedSoup {
  /**
   * Gives the triangles texture coordinates without a need of neighbours, connections or an inside (Schier, Hartmann & Klein 2018): lines of
   * the electrostatic field of the charged soup lead from its corners to a closed proxy around it, which is cut into charts, laid flat and
   * packed. The soup stays as it is. Fails with `EmptyInput` if no triangle has an area, and with `DoesNotFit` if the charts and their
   * margins do not fit into `texels`.
   */
  texture(options?: TextureOptions): Promise<Texture>;
  /** The smallest offset, to 4 %, at which the proxy is in one piece; 1/80 of the longest side if that is enough. */
  suggestOffset(options?: Pick<ProxyOptions, 'sides'> & CallOptions): Promise<number>;
  /** Texture coordinates by a standard projection, `triplanar` unless said otherwise: quick, and to compare `texture` with. */
  project(options?: { method?: Projection }): Promise<Projected>;
}
