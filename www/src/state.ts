import type { Bounds, CheckReport, Cloud, HeatMap, Info, Layer, Prepared, Soup, Voxels, Warning } from 'fast-winding';
import type { Tool } from './address.ts';
import type { AffectedKind } from './affected.ts';
import type { Comparison } from './comparison.ts';
import type { DefectKind } from './defects.ts';
import type { PlaneDistances } from './distances.ts';
import type { Result } from './made.ts';
import type { Picture } from './picture.ts';
import { UNMOVED } from './placement.ts';
import type { Placement } from './placement.ts';
import type { MoveKind, Nozzle, Print, Recipe } from './print.ts';
import type { Problem } from './problem.ts';
import type { Combined, Offset, Repair, SurfaceMesh } from './results.ts';
import type { Seam, Texturing } from './texture.ts';

/** What is drawn of the model itself: positions relative to `origin`. */
export interface Geometry {
  positions: Float32Array;
  /** Three a triangle; absent for a cloud. */
  indices?: Uint32Array;
  /** One a point, of unit length; absent for a soup and for a cloud not oriented yet. */
  normals?: Float32Array;
  /** Two ends of each boundary edge. */
  boundary: Float32Array;
  origin: Float64Array;
}

export interface Model {
  readonly name: string;
  readonly shape: Soup | Cloud;
  readonly geometry: Geometry;
  readonly bounds: Bounds;
  /** Of its file. */
  readonly format: string;
  readonly warnings: readonly Warning[];
  /** False for a cloud that has no normals yet: it has no inside. */
  readonly oriented: boolean;
  readonly readMilliseconds: number;
  /** Absent until the field can be built. */
  readonly prepared?: Prepared;
}

/** A result and the time its call took. */
export interface Timed<T> {
  readonly value: T;
  readonly milliseconds: number;
}

/** The stack of layers that the slider runs through; the plane cuts layer `index` at its middle. */
export interface Plane {
  readonly index: number;
  readonly count: number;
  readonly layerHeight: number;
}

/** A quantity of each point of a cloud. */
export interface PointMeasure {
  readonly quantity: 'area' | 'noise';
  readonly values: Float64Array;
}

/** What the plane is coloured by. */
export type PlaneColours = 'none' | 'winding' | 'distance';

/** What a model is held against when it is checked. */
export interface Limits {
  /** Millimetres. */
  readonly minimumThickness: number;
  /** Degrees from the vertical. */
  readonly overhangAngle: number;
}

/** The defects of the model, or the triangles of its texture, that are coloured: all places of a kind, or the camera on one of them. */
export interface ShownDefect {
  readonly kind: DefectKind | AffectedKind;
  readonly place?: number;
}

/** What the model is combined with. */
export interface Second {
  readonly name: string;
  readonly shape: Soup | Cloud;
  readonly geometry: Geometry;
  readonly bounds: Bounds;
}

export type GizmoMode = 'translate' | 'rotate' | 'scale';

/** Formats that meshes are saved in. */
export const MESH_FORMATS = ['stl', 'obj', 'ply', '3mf'] as const;
export type MeshFormat = (typeof MESH_FORMATS)[number];

export interface Job {
  readonly label: string;
  readonly stage: string;
  /** 0 to 1; undefined while it is not known. */
  readonly fraction?: number;
  readonly canCancel: boolean;
  /** Whether it makes way for any other, to come back after that. */
  readonly isPatient?: boolean;
}

/** Whether no other job may start. */
export function isBusy({ job }: State): boolean {
  return job !== undefined && !job.isPatient;
}

export const ITEMS = [
  'model', 'boundary', 'normals', 'layer', 'defects', 'repaired', 'voxels', 'difference', 'surface', 'offset', 'second', 'combined', 'proxy', 'fieldLines',
  'textured', 'print',
] as const;
/** What can be shown or hidden in the 3D view. */
export type Item = (typeof ITEMS)[number];

export interface State {
  info?: Info;
  model?: Model;
  /** Whether the browser keeps the model's file, or what was made of a sample; undefined until it is known, or there is nothing of either. */
  kept?: boolean;
  /** Names of what else is not kept. */
  unkept: readonly string[];
  /** Where the person is. */
  tool?: Tool;
  plane: Plane;
  layer?: Timed<Layer>;
  heat?: Timed<HeatMap>;
  distances?: Timed<PlaneDistances>;
  planeColours: PlaneColours;
  cutAway: boolean;
  voxels?: Timed<Voxels>;
  surface?: Timed<SurfaceMesh>;
  /** What is wrong with the model as it is. */
  report?: Timed<CheckReport>;
  limits: Limits;
  defect?: ShownDefect;
  repair?: Timed<Repair>;
  offset?: Timed<Offset>;
  second?: Second;
  /** Of the second model. */
  placement: Placement;
  gizmo: GizmoMode;
  combined?: Timed<Combined>;
  texture?: Timed<Texturing>;
  /** Drawn on the proxy by the person; the charts are cut along them when they are laid flat again. */
  seams: readonly Seam[];
  /** The vertex of the proxy that the next seam starts at. */
  seamStart?: number;
  /** Whether a click on the proxy marks a place for a seam. */
  isDrawing: boolean;
  /** What the texture shows; a checker unless chosen. */
  picture?: Picture;
  /** Whether something runs along the field lines. */
  isFlowing: boolean;
  /** All that was made of the model, the newest last. */
  results: readonly Result[];
  /** What the left half of the view shows instead of the model. */
  against?: Result;
  /** Ways of making voxels, side by side. */
  comparison?: Comparison;
  /** What meshes are saved as. */
  meshFormat: MeshFormat;
  /** Normals that are being estimated, as they are now. */
  settling?: Float32Array;
  /** What the points are coloured by. */
  measure?: PointMeasure;
  /** Whether the model and what was made of it are shown side by side. */
  halves: boolean;
  /** How the model is to be printed; absent until the engine has told its defaults. */
  recipe?: Recipe;
  /** Why that cannot be printed, in words. */
  misfit?: string;
  print?: Timed<Print>;
  /** What of the print is shown: what the nozzle has laid so far. */
  nozzle: Nozzle;
  /** Whether of the print only the layer at the nozzle is shown. */
  onlyLayer: boolean;
  isPlaying: boolean;
  hiddenMoves: ReadonlySet<MoveKind>;
  visible: Readonly<Record<Item, boolean>>;
  job?: Job;
  /** What has happened last. */
  note?: string;
  problem?: Problem;
}

export function initialState(): State {
  return {
    plane: { index: 0, count: 0, layerHeight: 1 },
    planeColours: 'none',
    limits: { minimumThickness: 0.8, overhangAngle: 50 },
    placement: UNMOVED,
    gizmo: 'translate',
    seams: [],
    isDrawing: false,
    isFlowing: false,
    results: [],
    unkept: [],
    meshFormat: 'stl',
    halves: false,
    cutAway: false,
    nozzle: { layer: 0, moves: 0 },
    onlyLayer: false,
    isPlaying: false,
    hiddenMoves: new Set(['travel'] as const),
    visible: { ...allOf(true), normals: false },
  };
}

/** What is made of a model, when it is new: nothing. */
export const NOTHING_MADE = {
  layer: undefined,
  heat: undefined,
  distances: undefined,
  voxels: undefined,
  comparison: undefined,
  surface: undefined,
  report: undefined,
  defect: undefined,
  repair: undefined,
  offset: undefined,
  combined: undefined,
  texture: undefined,
  results: [],
  against: undefined,
  seams: [],
  seamStart: undefined,
  isDrawing: false,
  measure: undefined,
  print: undefined,
  isPlaying: false,
} as const satisfies Partial<State>;

export function allOf(isVisible: boolean): Record<Item, boolean> {
  return Object.fromEntries(ITEMS.map((item) => [item, isVisible])) as Record<Item, boolean>;
}
