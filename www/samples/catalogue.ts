/** One entry of the page's menu of samples. */
export interface Sample {
  /** File name, also the path under `samples/`. */
  readonly file: string;
  readonly title: string;
  /** What makes it worth a look. */
  readonly note: string;
}

export const SAMPLES = [
  { file: 'bunny.stl', title: 'Stanford bunny, as scanned', note: 'Open underneath: five holes' },
  { file: 'dragon.ply', title: 'Stanford dragon', note: 'Decimated until it tore' },
  { file: 'head.ply', title: 'Head, 3D scan', note: 'A bust, open at the bottom' },
  { file: 'teapot.obj', title: 'Utah teapot', note: 'A soup: parts that cross and do not join' },
  { file: 'dragon-points.ply', title: 'Dragon, points with normals', note: 'No triangles at all' },
  { file: 'bunny-points.xyz', title: 'Bunny, points only', note: 'No triangles and no normals' },
] as const satisfies readonly Sample[];

export type SampleFile = (typeof SAMPLES)[number]['file'];
