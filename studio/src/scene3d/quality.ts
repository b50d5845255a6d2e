// Fewer pixels while drawing is slow, as in software; all of them once nothing moves.

const LEVELS = [1, 0.75, 0.55] as const;
const SLOW_MS = 45;
const FAST_MS = 20;
const FRAMES = 6;

/** Decides with how many of its pixels a frame is drawn, from how long the browser was busy with the last ones. */
export class Quality {
  private level = 0;
  private readonly delays: number[] = [];

  /** The share of pixels along each axis. */
  get scale(): number {
    return LEVELS[this.level] ?? 1;
  }

  /** Note how many ms after a frame the browser was ready for the next one; return whether the scale changes. */
  note(delay: number): boolean {
    this.delays.push(delay);
    if (this.delays.length < FRAMES) return false;
    const mean = this.delays.reduce((sum, each) => sum + each, 0) / FRAMES;
    this.delays.length = 0;
    const before = this.level;
    if (mean > SLOW_MS) this.level = Math.min(LEVELS.length - 1, this.level + 1);
    else if (mean < FAST_MS) this.level = Math.max(0, this.level - 1);
    return this.level !== before;
  }
}
