/** Red, green and blue from 0 to 255. */
export type Rgb = readonly [number, number, number];

/** The colour at a place from 0 to 1, beyond which it stays what it is at the ends, between evenly spaced stops. */
export function between(stops: readonly Rgb[], place: number): Rgb {
  const along = Math.min(1, Math.max(0, place)) * (stops.length - 1);
  const below = Math.min(stops.length - 2, Math.floor(along));
  const part = along - below;
  return [0, 1, 2].map((k) => stops[below][k] + part * (stops[below + 1][k] - stops[below][k])) as unknown as Rgb;
}

const COLUMNS = 256;

/** Paints a scale of colours, low on the left. */
export function paintScale(bar: HTMLCanvasElement, { low, high }: { low: number; high: number }, colourAt: (value: number) => Rgb): void {
  bar.width = COLUMNS;
  bar.height = 1;
  const context = bar.getContext('2d')!;
  for (let column = 0; column < COLUMNS; column++) {
    const value = low + ((column + 0.5) / COLUMNS) * (high - low);
    context.fillStyle = `rgb(${colourAt(value).map(Math.round).join(' ')})`;
    context.fillRect(column, 0, 1, 1);
  }
}
