// Signals over time in a ring, for plots: columns of equal length with a common time.
import type { Sample } from "../api/types";

/** A line of a plot: `unit` decides the axis. */
export interface Line {
  name: string;
  unit: string;
}

/** The newest `capacity` rows of some lines; NaN where a value is not known. */
export class Series {
  private start = 0;
  private count = 0;
  private readonly rows: Float64Array;

  constructor(
    readonly lines: readonly Line[],
    private readonly capacity: number,
  ) {
    this.rows = new Float64Array(capacity * (lines.length + 1));
  }

  get length(): number {
    return this.count;
  }

  /** Add a row; one that is not later than the last one is left out. */
  add(time: number, values: readonly number[]): void {
    const width = this.lines.length + 1;
    if (this.count > 0 && time <= (this.timeAt(this.count - 1) ?? -Infinity)) return;
    const at = ((this.start + this.count) % this.capacity) * width;
    this.rows[at] = time;
    for (let index = 0; index < this.lines.length; index++) this.rows[at + 1 + index] = values[index] ?? NaN;
    if (this.count < this.capacity) this.count++;
    else this.start = (this.start + 1) % this.capacity;
  }

  /** Return the columns, the time first, as a plot takes them. */
  columns(): (number | null)[][] {
    const width = this.lines.length + 1;
    return Array.from({ length: width }, (_, column) =>
      Array.from({ length: this.count }, (_, row) => {
        const value = this.rows[((this.start + row) % this.capacity) * width + column] ?? NaN;
        return Number.isNaN(value) ? null : value;
      }),
    );
  }

  private timeAt(row: number): number | undefined {
    return this.rows[((this.start + row) % this.capacity) * (this.lines.length + 1)];
  }
}

/** Return the length of a vector. */
export function norm(vector: readonly number[]): number {
  return Math.hypot(...vector);
}

/** Computes what is plotted of an arm live: the force at its wrist in N, and the speed of its tool in m/s. */
export class ArmMeter {
  private before: { time: number; tool: readonly number[] } | null = null;

  measure(sample: Sample, arm: string): [force: number, speed: number] {
    const now = sample.arms[arm];
    if (now === undefined) return [NaN, NaN];
    const force = now.wrench === null ? NaN : norm(now.wrench.slice(0, 3));
    const seconds = this.before === null ? 0 : sample.time_s - this.before.time;
    const tool = now.tool.slice(0, 3);
    const moved =
      this.before === null ? [] : tool.map((each, axis) => each - (this.before?.tool[axis] ?? each));
    this.before = { time: sample.time_s, tool };
    return [force, seconds > 0 ? norm(moved) / seconds : NaN];
  }
}
