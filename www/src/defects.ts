/** What a check may find, in words, and the parts of the model that it names. */
import type { CheckReport, FieldRegion } from 'fast-winding';
import { length, plural, significant, volume } from './format.ts';
import type { Named } from './places.ts';

export type DefectKind =
  | 'holes' | 'flipped' | 'inconsistent' | 'crossing' | 'nonManifoldEdges' | 'nonManifoldVertices' | 'internal' | 'outside' | 'duplicates'
  | 'degenerate' | 'slivers' | 'ambiguous' | 'overlaps' | 'inverted' | 'thin' | 'overhangs';

/** Whether it makes a broken surface, or is to be known alone. */
export type Weight = 'alarm' | 'caution' | 'note';

interface Kind {
  readonly label: string;
  /** What it means for whoever wants to use or print the model. */
  readonly note: string;
  readonly weight: Weight;
  /** How many there are, in words; nothing if there are none or it was not looked for. */
  figure(report: CheckReport): string | undefined;
  named(report: CheckReport): Named;
}

const NOTHING = new Uint32Array();

/** The most harmful first. */
const KINDS: Record<DefectKind, Kind> = {
  holes: {
    label: 'Holes',
    note: 'Edges with a face on one side only. The field closes them for layers, voxels and surfaces; other programs may refuse them.',
    weight: 'alarm',
    figure: ({ boundary: { edges, loops } }) => some(loops.count) && `${plural(loops.count, 'hole')}, ${plural(edges, 'edge')}`,
    named: ({ boundary }) => ({ loops: boundary.loops.list.map(({ vertices, isClosed }) => ({ vertices, isClosed })) }),
  },
  flipped: {
    label: 'Flipped faces',
    note: 'Their front looks into the solid. Turning them over puts them right.',
    weight: 'alarm',
    figure: ({ flippedFaces }) => faces(flippedFaces.count),
    named: ({ flippedFaces }) => ({ faces: flippedFaces.list, areTurned: true }),
  },
  inconsistent: {
    label: 'Neighbours that disagree',
    note: 'Edges at which one face looks outward and the next one inward.',
    weight: 'alarm',
    figure: ({ inconsistentEdges }) => edges(inconsistentEdges.count),
    named: ({ inconsistentEdges }) => ({ edges: inconsistentEdges.list }),
  },
  crossing: {
    label: 'Self-intersections',
    note: 'Pairs of faces that go through each other.',
    weight: 'alarm',
    figure: ({ selfIntersections }) => some(selfIntersections?.count) && plural(selfIntersections!.count, 'pair'),
    named: ({ selfIntersections }) => ({ pairs: selfIntersections?.list ?? NOTHING }),
  },
  nonManifoldEdges: {
    label: 'Edges of three or more faces',
    note: 'Which of the faces belong together is not said.',
    weight: 'alarm',
    figure: ({ nonManifoldEdges }) => edges(nonManifoldEdges.count),
    named: ({ nonManifoldEdges }) => ({ edges: nonManifoldEdges.list }),
  },
  nonManifoldVertices: {
    label: 'Parts that touch at a point',
    note: 'Faces meet there that no edge leads from one to the other.',
    weight: 'caution',
    figure: ({ nonManifoldVertices }) => some(nonManifoldVertices.count) && plural(nonManifoldVertices.count, 'vertex', 'vertices'),
    named: ({ nonManifoldVertices }) => ({ vertices: nonManifoldVertices.list }),
  },
  internal: {
    label: 'Internal faces',
    note: 'Both of their sides are inside the solid: they bound nothing.',
    weight: 'caution',
    figure: ({ internalFaces }) => faces(internalFaces.count),
    named: ({ internalFaces }) => ({ faces: internalFaces.list }),
  },
  outside: {
    label: 'Faces around nothing',
    note: 'Both of their sides are outside: they are not printed.',
    weight: 'caution',
    figure: ({ outsideFaces }) => faces(outsideFaces.count),
    named: ({ outsideFaces }) => ({ faces: outsideFaces.list }),
  },
  duplicates: {
    label: 'Duplicates',
    note: 'The same corners as an earlier face.',
    weight: 'caution',
    figure: ({ duplicateFaces }) => faces(duplicateFaces.count),
    named: ({ duplicateFaces }) => ({ faces: duplicateFaces.list }),
  },
  degenerate: {
    label: 'Faces without area',
    note: 'Their corners lie on a line or in a point.',
    weight: 'caution',
    figure: ({ degenerateFaces }) => faces(degenerateFaces.count),
    named: ({ degenerateFaces }) => ({ faces: degenerateFaces.list }),
  },
  slivers: {
    label: 'Slivers',
    note: 'Very thin for their length. Harmless for the field and for printing.',
    weight: 'note',
    figure: ({ sliverFaces }) => faces(sliverFaces.count),
    named: ({ sliverFaces }) => ({ faces: sliverFaces.list }),
  },
  ambiguous: {
    label: 'Neither inside nor outside',
    note: 'The winding number is between 0.1 and 0.9 here: the surface around is not closed.',
    weight: 'alarm',
    figure: ({ field }) => some(field?.ambiguousVolume) && `${volume(field!.ambiguousVolume)}, ${significant(100 * field!.ambiguousShare, 2)} % of the box`,
    named: ({ field }) => regions(field, 'ambiguous'),
  },
  overlaps: {
    label: 'Enclosed twice',
    note: 'The winding number is 2 or more: solids overlap here. They print as one.',
    weight: 'caution',
    figure: ({ field }) => some(field?.overlapVolume) && volume(field!.overlapVolume),
    named: ({ field }) => regions(field, 'overlap'),
  },
  inverted: {
    label: 'Inside out',
    note: 'The winding number is −1 or less: a shell around it is turned inward, and it does not print.',
    weight: 'alarm',
    figure: ({ field }) => some(field?.invertedVolume) && volume(field!.invertedVolume),
    named: ({ field }) => regions(field, 'inverted'),
  },
  thin: {
    label: 'Thin walls',
    note: 'The solid behind these faces is thinner than the least thickness.',
    weight: 'caution',
    figure: ({ thickness }) => some(thickness?.thinFaces.count) && `${faces(thickness!.thinFaces.count)}, from ${length(thickness!.minimum)}`,
    named: ({ thickness }) => ({ faces: thickness?.thinFaces.list ?? NOTHING }),
  },
  overhangs: {
    label: 'Overhangs',
    note: 'They lean out by more than the angle and have nothing under them: they need supports.',
    weight: 'note',
    figure: ({ overhangs }) => some(overhangs.faces.count) && `${faces(overhangs.faces.count)}, ${significant(overhangs.area, 3)} mm²`,
    named: ({ overhangs }) => ({ faces: overhangs.faces.list }),
  },
};

export const DEFECT_KINDS = Object.keys(KINDS) as DefectKind[];

/** Something that a person can have shown, as a line of a list. */
export interface Finding<K extends string> {
  readonly kind: K;
  readonly label: string;
  readonly note: string;
  readonly weight: Weight;
  readonly figure: string;
}

/** What the check found, and the names of what it did not find. */
export function defectsOf(report: CheckReport): { found: Finding<DefectKind>[]; absent: string[] } {
  const found: Finding<DefectKind>[] = [];
  const absent: string[] = [];
  for (const kind of DEFECT_KINDS) {
    const { label, note, weight, figure } = KINDS[kind];
    const text = figure(report);
    if (text) found.push({ kind, label, note, weight, figure: text });
    else absent.push(label.toLowerCase());
  }
  return { found, absent };
}

/** The faces, edges, vertices or regions of a defect. */
export function namedBy(report: CheckReport, kind: DefectKind): Named {
  return KINDS[kind].named(report);
}

function some(value: number | null | undefined): true | undefined {
  return value ? true : undefined;
}

function faces(value: number): string | undefined {
  return value > 0 ? plural(value, 'face') : undefined;
}

function edges(value: number): string | undefined {
  return value > 0 ? plural(value, 'edge') : undefined;
}

function regions(field: CheckReport['field'], kind: FieldRegion['kind']): Named {
  return { boxes: field?.regions.list.filter((region) => region.kind === kind).map(({ bounds }) => bounds) ?? [] };
}
