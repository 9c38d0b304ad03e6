/** One entry of the page's menu of samples. */
export interface Sample {
  /** File name, also the path under `samples/`. */
  readonly file: string;
  readonly title: string;
  /** What makes it worth a look. */
  readonly note: string;
}

export const SAMPLES = [
  { file: 'bunny.stl', title: 'Stanford bunny, as scanned', note: 'A scan with five holes underneath' },
  { file: 'dragon.ply', title: 'Stanford dragon', note: 'Fine scales and thin horns' },
  { file: 'head.ply', title: 'Bust', note: 'A hollow shell and a few stray triangles' },
  { file: 'teapot.obj', title: 'Utah teapot', note: 'A soup: open parts that cross and do not join' },
  { file: 'dragon-points.ply', title: 'Dragon, points with normals', note: 'No triangles: the surface is made from w alone' },
  { file: 'bunny-points.xyz', title: 'Bunny, points only', note: 'No triangles, and no normals until they are estimated' },
] as const satisfies readonly Sample[];

export type SampleFile = (typeof SAMPLES)[number]['file'];
