/** Triangles of a texture that did not simply go where their field lines meet the proxy, in words. */
import type { AffectedTriangles } from 'fast-winding';
import type { Finding, Weight } from './defects.ts';
import { count, plural } from './format.ts';

export type AffectedKind = 'mirrored' | 'torn' | 'unfolded' | 'weak' | 'lost' | 'tangential' | 'across';

interface Kind {
  readonly list: keyof AffectedTriangles;
  readonly label: string;
  readonly note: string;
  readonly weight: Weight;
}

/** The worst first. */
const KINDS: Record<AffectedKind, Kind> = {
  mirrored: { list: 'flipped', label: 'Mirrored or flat', note: 'Their part of the picture is seen from behind, or has no area.', weight: 'alarm' },
  torn: { list: 'torn', label: 'Far too large or small', note: 'Their part of the picture is more than eight times as large as it should be, or as small.', weight: 'alarm' },
  unfolded: {
    list: 'unfolded',
    label: 'Laid flat by themselves',
    note: 'They are in a chart as they are in space, as they would have been folded or squashed there: the picture breaks at their edges.',
    weight: 'caution',
  },
  weak: { list: 'weak', label: 'In narrow places', note: 'Field lines do not lead out well: a proxy that is nearer follows them closer.', weight: 'caution' },
  lost: { list: 'lost', label: 'Without a way to the proxy', note: 'A field line of theirs does not meet it: that corner has its nearest point.', weight: 'note' },
  tangential: { list: 'tangential', label: 'Lines along the surface', note: 'A field line of theirs ran along the model, and a straight one took its place.', weight: 'note' },
  across: { list: 'across', label: 'Across seams', note: 'Their corners met different charts. Those that could be moved into one are textured without a tear.', weight: 'note' },
};

const AFFECTED_KINDS = Object.keys(KINDS) as AffectedKind[];

export function isAffected(kind: string): kind is AffectedKind {
  return kind in KINDS;
}

export function affectedTriangles(affected: AffectedTriangles, kind: AffectedKind): Uint32Array {
  return affected[KINDS[kind].list];
}

/** Those kinds that there are any of. */
export function affectedOf(affected: AffectedTriangles): Finding<AffectedKind>[] {
  return AFFECTED_KINDS.flatMap((kind) => {
    const { list, label, note, weight } = KINDS[kind];
    const triangles = affected[list].length;
    const moved = kind === 'across' ? `, ${count(affected.moved.length)} moved` : '';
    return triangles > 0 ? [{ kind, label, note, weight, figure: `${plural(triangles, 'triangle')}${moved}` }] : [];
  });
}
