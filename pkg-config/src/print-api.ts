// Toolpaths and printers, as the package's callers see them. Lengths are in millimetres, angles in degrees.
import type { Warning } from './common-api.js';

/** How layers are filled with lines. `printSettings` gives the defaults. */
export interface ToolpathSettings {
  /** 0.4 unless given. */
  lineWidth?: number;
  /** Lines around each part. */
  perimeters?: number;
  /** How far neighbouring walls overlap, as a share of the line's width. */
  wallOverlap?: number;
  /** How far infill and skins reach into the innermost wall, as a share of the line's width. */
  infillOverlap?: number;
  /** `rectilinear` unless given. */
  infill?: 'rectilinear' | 'grid' | 'gyroid';
  /** Share of the inside that infill covers, from 0 to 1. */
  density?: number;
  /** Direction of infill, from +x towards +y. */
  angle?: number;
  /** Solid layers over whatever is open below: 4 unless given. */
  bottomLayers?: number;
  /** Solid layers under whatever is open above: 4 unless given. */
  topLayers?: number;
  /** Where walls start: where the nozzle gets to first, at the back, above each other, or anywhere. */
  seam?: 'nearest' | 'rear' | 'aligned' | 'random';
  /** Grows all contours by this, or shrinks them where it is negative. */
  xyCompensation?: number;
  /** Shrinks the first layer by this. */
  elephantFoot?: number;
  /** Narrower parts of a layer are left out, with a warning. */
  minimumFeature?: number;
  /** Walls too thin for two lines get a single one, or are reported. */
  thinWalls?: 'singleLine' | 'report';
  /** Walls that lean out by more than this from the vertical are overhangs. */
  overhangAngle?: number;
  /** Whether skins over nothing run straight from one support to the other. */
  bridges?: boolean;
  /** Vertices go that lie within this of the line without them. */
  detail?: number;
}

/** How often something was met, and its area in square millimetres, over all layers. */
export interface Regions {
  /** How many. */
  count: number;
  /** Square millimetres. */
  area: number;
}

/** The lines of one layer in the order they are laid. Path k has the points (xy) from `starts[k]` to `starts[k + 1]`. */
export interface LayerPaths {
  /** Where the nozzle lays them, in the model's frame. */
  z: number;
  /** Of the layer. */
  height: number;
  /** xyxy… in the frame of the model. */
  points: Float64Array;
  /** One more than paths. */
  starts: Uint32Array;
  /** Of each path, the place of its kind in `Toolpaths.kinds`. */
  kinds: Uint8Array;
  /** Of each path. */
  widths: Float64Array;
  /** Bit 0: the path is closed, its first point not repeated; bit 1: the nozzle gets to it all over the inside. */
  flags: Uint8Array;
}

/** What a line is for. */
export type PathKind =
  | 'outerWall' | 'innerWall' | 'thinWall' | 'gap' | 'overhang' | 'bottom' | 'top' | 'solid' | 'bridge' | 'infill';

/** Lines for a nozzle, layer by layer. */
export interface Toolpaths {
  /** Bottom to top. */
  layers: LayerPaths[];
  /** Names of the numbers in `LayerPaths.kinds`. */
  kinds: PathKind[];
  /** What was met on the way. */
  report: {
    /** Parts that have no room for a line along either side, and how many of them got a single one. */
    thinWalls: Regions;
    singleLines: number;
    /** Parts narrower than `minimumFeature`. */
    dropped: Regions;
    bridges: Regions;
    /** Skins over nothing that want support. */
    overhangs: Regions;
    /** Millimetres of walls that lean out too far. */
    overhangingWalls: number;
  };
  /** What was left out or reported, such as parts too thin for a line. */
  warnings: Warning[];
}

/** A machine and what is loaded, as a JSON file may hold it. Temperatures in °C, speeds in millimetres a second. */
export interface PrinterProfile {
  /** For people. */
  name?: string;
  /** Along x. */
  bedWidth?: number;
  /** Along y. */
  bedDepth?: number;
  /** The largest z. */
  height?: number;
  /** Where x = 0, y = 0 is: the front left corner of the bed, or its middle. */
  origin?: 'corner' | 'center';
  /** Where its coordinates say if that is on the bed, else in the middle; where they say; or in the middle. */
  placement?: 'onBed' | 'asIs' | 'centered';
  /** Of the nozzle. */
  nozzleDiameter?: number;
  /** 1.75 unless given. */
  filamentDiameter?: number;
  /** Grams per cubic centimetre. */
  filamentDensity?: number;
  /** °C. */
  nozzleTemperature?: number;
  /** °C. */
  bedTemperature?: number;
  /** From the second layer on, from 0 to 1. */
  fan?: number;
  /** Millimetres a second, by what is laid; `firstLayer` is for all of the first. */
  speeds?: {
    travel?: number;
    firstLayer?: number;
    outerWall?: number;
    innerWall?: number;
    infill?: number;
    solid?: number;
    top?: number;
    bridge?: number;
    overhang?: number;
  };
  /** Millimetres per second squared. */
  acceleration?: number;
  /** How far corners may be rounded, by which speed in them is estimated. */
  junctionDeviation?: number;
  /** How filament is drawn back: `length` and `lift` in millimetres, `speed` in millimetres a second; shorter travels than `minimumTravel` go without. */
  retraction?: { length?: number; speed?: number; minimumTravel?: number; lift?: number };
  /** G-code before and after the print; names in braces such as `{nozzleTemperature}` are replaced. */
  start?: string;
  /** As `start`, after the print. */
  end?: string;
}

/** A profile in which nothing is missing. */
export type RequiredProfile = Required<Omit<PrinterProfile, 'speeds' | 'retraction'>> & {
  speeds: Required<NonNullable<PrinterProfile['speeds']>>;
  retraction: Required<NonNullable<PrinterProfile['retraction']>>;
};

/** A program for a printer, and what it takes. */
export interface GCode {
  /** Text. */
  bytes: Uint8Array;
  /** What was added to the model's coordinates. */
  shift: [number, number, number];
  /** What the print takes. */
  estimate: {
    /** Without heating. */
    seconds: number;
    /** Millimetres. */
    filamentLength: number;
    /** Cubic millimetres. */
    filamentVolume: number;
    /** Grams. */
    filamentMass: number;
    /** Millimetres of lines laid, and of ways between them. */
    extrudedLength: number;
    travelLength: number;
    /** How often filament is drawn back. */
    retractions: number;
  };
  /** What should be looked at before printing. */
  warnings: Warning[];
}
