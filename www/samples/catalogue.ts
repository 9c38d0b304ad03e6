/** One entry of the page's menu of samples. */
export interface Sample {
  /** File name, also the path under `samples/`. */
  readonly file: string;
  readonly title: string;
  /** What makes it worth a look. */
  readonly note: string;
  /** Who made it. */
  readonly credit: string;
}

const STANFORD = 'Stanford Computer Graphics Laboratory';

export const SAMPLES = [
  { file: 'bunny.stl', title: 'Stanford bunny, as scanned', note: 'A scan with five holes underneath', credit: STANFORD },
  { file: 'dragon.ply', title: 'Stanford dragon', note: 'Fine scales and thin horns', credit: STANFORD },
  { file: 'head.ply', title: 'Bust', note: 'A hollow shell and a few stray triangles', credit: 'Snowden monument, thingiverse 815042' },
  { file: 'teapot.obj', title: 'Utah teapot', note: 'A soup: open parts that cross and do not join', credit: 'Martin Newell' },
  { file: 'dragon-points.ply', title: 'Dragon, points with normals', note: 'No triangles: the surface is made from w alone', credit: STANFORD },
  { file: 'bunny-points.xyz', title: 'Bunny, points only', note: 'No triangles, and no normals until they are estimated', credit: STANFORD },
] as const satisfies readonly Sample[];

export type SampleFile = (typeof SAMPLES)[number]['file'];
