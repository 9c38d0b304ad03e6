import type { GCode, Layer, PathKind, RequiredProfile, ToolpathSettings, Warning } from 'fast-winding';
import type { Segments } from './segments.ts';

/** How a model is to be printed. */
export interface Recipe {
  readonly layerHeight: number;
  readonly settings: Required<ToolpathSettings>;
  readonly profile: RequiredProfile;
}

/** A print that is ready: what is drawn, and what is saved. */
export interface Print {
  readonly recipe: Recipe;
  readonly layers: readonly Layer[];
  readonly segments: Segments;
  readonly gcode: GCode;
  /** Of the toolpaths and of the program. */
  readonly warnings: readonly Warning[];
}

/** Where the nozzle is in a print: it has laid the layers below, and so many moves of its own, the last perhaps in part. */
export interface Nozzle {
  readonly layer: number;
  readonly moves: number;
}

export type MoveKind = PathKind | 'travel';

/** Names of the kinds of moves, and the tokens of their colours. */
export const KINDS: Record<MoveKind, { readonly label: string; readonly token: string }> = {
  outerWall: { label: 'Outer walls', token: '--print-outer-wall' },
  innerWall: { label: 'Inner walls', token: '--print-inner-wall' },
  thinWall: { label: 'Thin walls', token: '--print-thin-wall' },
  gap: { label: 'Gaps between walls', token: '--print-gap' },
  overhang: { label: 'Overhangs', token: '--print-overhang' },
  bottom: { label: 'Bottoms', token: '--print-bottom' },
  top: { label: 'Tops', token: '--print-top' },
  solid: { label: 'Solid inside', token: '--print-solid' },
  bridge: { label: 'Bridges', token: '--print-bridge' },
  infill: { label: 'Infill', token: '--print-infill' },
  travel: { label: 'Travel', token: '--print-travel' },
};

/** The same recipe for another printer: lines as wide as the nozzle stay as wide as the nozzle. */
export function withProfile(recipe: Recipe, profile: RequiredProfile): Recipe {
  const { settings } = recipe;
  const isNozzleWide = settings.lineWidth === recipe.profile.nozzleDiameter;
  return { ...recipe, profile, settings: isNozzleWide ? { ...settings, lineWidth: profile.nozzleDiameter } : settings };
}
