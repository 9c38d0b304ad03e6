import type { CheckReport } from 'fast-winding';
import { affectedTriangles, isAffected } from './affected.ts';
import { centreOf } from './bounds.ts';
import { namedBy } from './defects.ts';
import { placesOf } from './places.ts';
import type { Located, Place } from './places.ts';
import type { Model, ShownDefect, State } from './state.ts';
import type { Texturing } from './texture.ts';

/** What is coloured: the places, and the triangles that these are of. */
export interface Shown {
  readonly places: readonly Place[];
  readonly geometry: Located;
}

/** Gathered once for each report, and for each texture. */
const known = new WeakMap<CheckReport | Texturing, Map<ShownDefect['kind'], Shown>>();

/** Of the defect that is shown, if what it was found by is there. */
export function shownOf({ model, report, texture, defect }: State): Shown | undefined {
  if (!model || !defect) return undefined;
  const source = isAffected(defect.kind) ? texture?.value : report?.value;
  if (!source) return undefined;
  const ofSource = known.get(source) ?? new Map<ShownDefect['kind'], Shown>();
  known.set(source, ofSource);
  const shown = ofSource.get(defect.kind) ?? find(model, source, defect.kind);
  ofSource.set(defect.kind, shown);
  return shown;
}

function find(model: Model, source: CheckReport | Texturing, kind: ShownDefect['kind']): Shown {
  const middle = centreOf(model.bounds).map((value, k) => value - model.geometry.origin[k]);
  if (!isAffected(kind)) return { places: placesOf(namedBy(source as CheckReport, kind), model.geometry, middle), geometry: model.geometry };
  const { soup, affected } = source as Texturing;
  const { origin } = model.geometry;
  const geometry = { positions: Float32Array.from(soup.positions, (value, i) => value - origin[i % 3]), indices: soup.indices, origin };
  return { places: placesOf({ faces: affectedTriangles(affected, kind) }, geometry, middle), geometry };
}
