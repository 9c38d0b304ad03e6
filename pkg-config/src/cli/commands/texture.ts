import type { Soup, Texture, TextureReport } from '../../api.js';
import { checkerPng } from '../checker.js';
import { type Task, command } from '../command.js';
import { endingOf } from '../destination.js';
import { glbOf, isPicture } from '../glb.js';
import { UsageError } from '../usage.js';
import { soupFrom } from '../shapes.js';
import { figure, length, plural, warningRows } from '../words.js';

/** Ending of the picture's file. */
const pictureEnding = (image: string | undefined): string => (image === undefined ? 'png' : endingOf(image));

async function pictureOf(task: Task, image: string | undefined): Promise<{ bytes: Uint8Array; ending: string }> {
  return { bytes: image === undefined ? checkerPng() : await task.readBytes(image), ending: pictureEnding(image) };
}

async function save(task: Task, texture: Texture, image: string | undefined): Promise<void> {
  const picture = await pictureOf(task, image);
  if (task.format === 'glb') return task.save(glbOf(await texture.geometry(), picture, task.stem));
  const { obj, mtl } = await texture.export('obj', { name: task.stem, image: `${task.stem}.${picture.ending}` });
  await task.saveBeside(mtl, 'mtl');
  await task.saveBeside(picture.bytes, picture.ending);
  await task.save(obj);
}

function rowsOf({ offset, proxyTriangles, proxyComponents, coverage, mapping, warnings }: TextureReport): [string, string][] {
  const { distortion } = mapping;
  return [
    ['proxy', `${length(offset)} away, ${plural(proxyTriangles, 'triangle')}, ${plural(proxyComponents, 'piece')}`],
    ['covered', `${figure(100 * coverage, 3)} % of the picture`],
    ['stretched', `${figure(distortion.meanRatio, 3)} to 1 on average, ${figure(distortion.largestRatio, 3)} at most`],
    ['bad', `${figure(mapping.flipped)} flipped or flat, ${figure(mapping.torn)} torn`],
    ...warningRows(warnings),
  ];
}

export const texture = command({
  name: 'texture',
  summary: 'a picture on triangles, however loose: GLB, or OBJ with its material',
  description: [
    'A closed mesh around the triangles, the proxy, is cut into charts that lie flat in a picture; lines of the electrostatic field carry that to the triangles, however loose they are.',
    'Beside NAME.obj there are NAME.mtl and the picture. A GLB holds it, in metres with y up, as glTF has it. The picture is a checker, whose squares show how the texture stretches, or a file of yours.',
  ],
  files: 'each',
  options: {
    offset: { kind: 'number', value: 'MM', help: 'how far the proxy is from the triangles (3 % of the longest side)' },
    onePiece: { kind: 'flag', help: 'in place of --offset: the smallest at which the proxy is in one piece' },
    resolution: { kind: 'whole', value: 'N', help: 'samples of the proxy along the longest side (two for each offset, 400 at most)' },
    sides: { kind: 'choice', choices: ['outer', 'both'], help: 'close openings that the triangles surround (outer, unless given), or go through them (both)' },
    smoothing: { kind: 'whole', value: 'N', help: 'rounds that smooth the proxy (0)' },
    cone: { kind: 'number', value: 'DEG', help: 'triangles of a chart face at most so far away from its axis, 10 to 80 (60)' },
    texels: { kind: 'whole', value: 'N', help: 'side of the picture (2048), in which --margin is measured' },
    margin: { kind: 'whole', value: 'N', help: 'texels between two charts (8)' },
    steps: { kind: 'whole', value: 'N', help: 'steps of a field line (100)' },
    refine: { kind: 'flag', help: 'first split triangles where they run through each other' },
    image: { kind: 'text', value: 'FILE', help: 'the picture, PNG or JPEG, in place of the checker' },
  },
  formats: ['glb', 'obj'],
  verify({ offset, onePiece, image }) {
    if (offset !== undefined && onePiece) throw new UsageError('give one of --offset and --one-piece');
    if (image !== undefined && !isPicture(endingOf(image))) throw new UsageError(`--image is ${JSON.stringify(image)}: a .png or .jpg file is needed`);
  },
  beside: (format, { image }) => (format === 'obj' ? ['mtl', pictureEnding(image)] : []),
  examples: ['texture chair.stl -o chair.glb', 'texture --offset 0.5 --image wood.jpg *.stl -o textured/ --format obj'],
  async run(task, { onePiece, image, ...options }) {
    const soup: Soup = soupFrom(task, 'texture');
    const { sides } = options;
    const offset = onePiece ? { offset: await soup.suggestOffset({ ...(sides && { sides }), ...task.call }) } : {};
    const made = await soup.texture({ ...options, ...offset, ...task.call });
    try {
      if (task.format) await save(task, made, image);
      const { report } = made;
      return { report, headline: `${plural(report.mapping.triangles, 'triangle')} in ${plural(report.charts, 'chart')}`, rows: rowsOf(report) };
    } finally {
      made.free();
    }
  },
});
