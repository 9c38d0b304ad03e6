// Progress on a terminal: one line on standard error, which the next report replaces.

const CELLS = 24;
/** Milliseconds between two looks of the line. */
const PAUSE = 80;

export class Progress {
  private done = 0;
  private shownAt = -Infinity;
  private isShown = false;

  constructor(
    private readonly total: number,
    private readonly isOn: boolean,
  ) {}

  /** What is being done to one of the inputs. */
  tell(name: string, fraction: number, stage: string): void {
    const now = performance.now();
    if (!this.isOn || now - this.shownAt < PAUSE) return;
    this.shownAt = now;
    const full = Math.round(fraction * CELLS);
    const bar = '█'.repeat(full) + '░'.repeat(CELLS - full);
    const count = this.total > 1 ? `${this.done}/${this.total} ` : '';
    const line = `${count}${bar} ${String(Math.round(100 * fraction)).padStart(3)} % ${name}: ${stage}`;
    process.stderr.write(`\r${line.slice(0, (process.stderr.columns ?? 80) - 1)}\x1b[K`);
    this.isShown = true;
  }

  finish(): void {
    this.done++;
  }

  /** Makes room for other lines. */
  clear(): void {
    if (this.isShown) process.stderr.write('\r\x1b[K');
    this.isShown = false;
    this.shownAt = -Infinity;
  }
}
