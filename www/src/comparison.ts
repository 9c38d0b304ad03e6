/** Ways of making voxels, held against the exact one. */
import type { VoxelDifference, VoxelMethod, Voxels } from 'fast-winding';

export type ComparedMethod = Extract<VoxelMethod, 'exact' | 'rays' | 'fast' | 'cloud'>;

export const METHODS: Record<ComparedMethod, { readonly label: string; readonly note: string; readonly ofClouds: boolean }> = {
  exact: { label: 'Exact', note: 'Asks w of every cell, to the last bit where it decides', ofClouds: true },
  rays: { label: 'Rays', note: 'Counts what rays cross: odd is inside. Holes make streaks', ofClouds: false },
  fast: { label: 'Fast', note: 'w as Barill et al. 2018 approximate it', ofClouds: true },
  cloud: { label: 'Points', note: 'Vertices with normals and areas take the place of triangles', ofClouds: false },
};

export function methodsFor(kind: 'soup' | 'cloud'): ComparedMethod[] {
  return (Object.keys(METHODS) as ComparedMethod[]).filter((method) => kind === 'soup' || METHODS[method].ofClouds);
}

export interface ComparedVoxels {
  readonly method: ComparedMethod;
  readonly voxels: Voxels;
  readonly milliseconds: number;
  /** From the exact ones; theirs is empty. */
  readonly difference: VoxelDifference;
}

export interface Comparison {
  /** The exact ones first. */
  readonly rows: readonly ComparedVoxels[];
  /** Whose wrong voxels are coloured. */
  readonly shown: ComparedMethod;
}

export function shownRow({ rows, shown }: Comparison): ComparedVoxels {
  return rows.find(({ method }) => method === shown) ?? rows[0];
}
