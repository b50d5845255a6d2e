// Fewer pixels while drawing is slow, as in software; more than the screen has once nothing moves, where edges need that.

const LEVELS = [1, 0.75, 0.55] as const;
const SLOW_MS = 45;
const FAST_MS = 20;
const FRAMES = 6;
/** Pixels along each axis for one of the screen, where drawing in software has no antialiasing, and how many at most. */
const [SHARP, MOST_PIXELS] = [2, 4e6];

/** Decides with how many pixels a frame is drawn, from how long the browser was busy with the last ones. */
export class Quality {
  readonly isSoftware = drawsInSoftware();
  private level = 0;
  private readonly delays: number[] = [];

  /** Return the pixels along each axis for one of CSS: while something moves, or `isSharp`, in a picture of an area. */
  scale(isSharp: boolean, area: number): number {
    if (!isSharp) return devicePixelRatio * (LEVELS[this.level] ?? 1);
    const fits = area * (devicePixelRatio * SHARP) ** 2 <= MOST_PIXELS;
    return devicePixelRatio * (this.isSoftware && fits ? SHARP : 1);
  }

  /** Note how many ms after a frame the browser was ready for the next one. */
  note(delay: number): void {
    this.delays.push(delay);
    if (this.delays.length < FRAMES) return;
    const mean = this.delays.reduce((sum, each) => sum + each, 0) / FRAMES;
    this.delays.length = 0;
    if (mean > SLOW_MS) this.level = Math.min(LEVELS.length - 1, this.level + 1);
    else if (mean < FAST_MS) this.level = Math.max(0, this.level - 1);
  }
}

/** Whether the browser has no graphics processor, by the name of what draws. */
function drawsInSoftware(): boolean {
  const probe = document.createElement("canvas").getContext("webgl2");
  const names = probe?.getExtension("WEBGL_debug_renderer_info");
  const name: unknown = names && probe?.getParameter(names.UNMASKED_RENDERER_WEBGL);
  probe?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|basic render/i.test(String(name));
}
