/** What a texture shows: a checker, or a picture of the person's. */

export interface Picture {
  readonly name: string;
  readonly canvas: HTMLCanvasElement;
  /** The person's file. */
  readonly given?: Blob;
  /** The file as it was given, if other programs read its format and it is not too large. */
  readonly file?: { readonly bytes: Uint8Array; readonly type: 'image/png' | 'image/jpeg' };
}

/** The picture as a file. */
export interface Encoded {
  readonly bytes: Uint8Array;
  readonly type: 'image/png' | 'image/jpeg';
  readonly extension: 'png' | 'jpg';
}

/** Larger pictures are made smaller: graphics cards have a limit. */
const MOST_PIXELS = 4096;
const CHECKER_PIXELS = 1024;
const CHECKER_CELLS = 32;
/** Cells in which one hue stands for a place. */
const CELLS_OF_HUE = 4;

let made: Picture | undefined;

/** Squares whose stretching shows how a texture distorts, and whose colours show which part of it is where. */
export function checker(): Picture {
  return (made ??= { name: 'checker', canvas: paintChecker() });
}

function paintChecker(): HTMLCanvasElement {
  const [canvas, context] = blank(CHECKER_PIXELS, CHECKER_PIXELS);
  const cell = CHECKER_PIXELS / CHECKER_CELLS;
  for (let j = 0; j < CHECKER_CELLS; j++) {
    for (let i = 0; i < CHECKER_CELLS; i++) {
      const [column, row] = [Math.floor(i / CELLS_OF_HUE), Math.floor(j / CELLS_OF_HUE)];
      const hue = (column * 47 + row * 101) % 360;
      context.fillStyle = (i + j) % 2 ? `hsl(${hue} 28% 90%)` : `hsl(${hue} 38% 52%)`;
      context.fillRect(i * cell, j * cell, cell, cell);
    }
  }
  return canvas;
}

/** Reads a file that the browser knows as an image. */
export async function readPicture(file: File): Promise<Picture> {
  const bitmap = await createImageBitmap(file);
  const scale = Math.min(1, MOST_PIXELS / Math.max(bitmap.width, bitmap.height));
  const [canvas, context] = blank(Math.max(1, Math.round(scale * bitmap.width)), Math.max(1, Math.round(scale * bitmap.height)));
  context.drawImage(bitmap, 0, 0, canvas.width, canvas.height);
  bitmap.close();
  const { type } = file;
  const isKnown = (type === 'image/png' || type === 'image/jpeg') && scale === 1;
  return { name: file.name, canvas, given: file, file: isKnown ? { bytes: new Uint8Array(await file.arrayBuffer()), type } : undefined };
}

/** A file of the picture that is as it was given, or else a PNG. */
export async function encoded({ canvas, file }: Picture): Promise<Encoded> {
  if (file) return { ...file, extension: file.type === 'image/png' ? 'png' : 'jpg' };
  return { bytes: await png(canvas), type: 'image/png', extension: 'png' };
}

async function png(canvas: HTMLCanvasElement): Promise<Uint8Array> {
  const blob = await new Promise<Blob | null>((done) => canvas.toBlob(done, 'image/png'));
  if (!blob) throw new Error('the picture is too large to be written');
  return new Uint8Array(await blob.arrayBuffer());
}

function blank(width: number, height: number): [HTMLCanvasElement, CanvasRenderingContext2D] {
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [width, height];
  return [canvas, canvas.getContext('2d')!];
}
