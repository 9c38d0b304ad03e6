import type { CheckReport } from 'fast-winding';
import { namedBy } from './defects.ts';
import type { DefectKind } from './defects.ts';
import { placesOf } from './places.ts';
import type { Place } from './places.ts';
import { centreOf } from './placement.ts';
import type { Model, State } from './state.ts';

/** Gathered once for each report. */
const known = new WeakMap<CheckReport, Map<DefectKind, Place[]>>();

/** The places of the defect that is shown. */
export function shownPlaces({ model, report, defect }: State): Place[] {
  if (!model || !report || !defect) return [];
  const ofReport = known.get(report.value) ?? new Map<DefectKind, Place[]>();
  known.set(report.value, ofReport);
  const places = ofReport.get(defect.kind) ?? placesOf(namedBy(report.value, defect.kind), model.geometry, middleOf(model));
  ofReport.set(defect.kind, places);
  return places;
}

/** In the scene's coordinates. */
function middleOf({ bounds, geometry: { origin } }: Model): number[] {
  return centreOf(bounds).map((value, k) => value - origin[k]);
}
