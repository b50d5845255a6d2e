// Signals over time in a ring, for plots: columns of equal length with a common time.
import type { Sample } from "../api/types";

/** A line of a plot: `unit` decides the axis. */
export interface Line {
  name: string;
  unit: string;
}

export type Kind = "force" | "contact" | "speed" | "commanded speed";

/** A line that can be chosen by its kind, and by what it is of: an arm or a tool. */
export interface SignalLine extends Line {
  kind: Kind;
  of: string;
}

/** Return the line of a kind of signal of a device, called alike live and in recordings. */
export function makeLine(kind: Kind, of: string): SignalLine {
  const unit = kind === "force" || kind === "contact" ? "N" : "m/s";
  return { name: `${kind} ${kind === "force" ? "at" : "of"} ${of}`, unit, kind, of };
}

/** How far apart samples may be in s of the cell: after more, what was between was missed, and is a gap. */
export const GAP_S = 0.5;

/** The newest `capacity` rows of some lines; NaN where a value is not known. */
export class Series {
  private start = 0;
  private count = 0;
  private readonly rows: Float64Array;

  constructor(
    readonly lines: readonly SignalLine[],
    private readonly capacity: number,
  ) {
    this.rows = new Float64Array(capacity * (lines.length + 1));
  }

  get length(): number {
    return this.count;
  }

  /** Add a row; one that is not later than the last one is left out. */
  add(time: number, values: readonly number[]): void {
    const before = this.count > 0 ? (this.timeAt(this.count - 1) ?? -Infinity) : -Infinity;
    if (time <= before) return;
    if (Number.isFinite(before) && time - before > GAP_S) this.push((time + before) / 2, []);
    this.push(time, values);
  }

  private push(time: number, values: readonly number[]): void {
    const width = this.lines.length + 1;
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

/** Return what is plotted of an arm live: the force at its wrist in N, the speeds of its tool and of its reference in m/s. */
export function measureArm(sample: Sample, arm: string): [force: number, speed: number, commanded: number] {
  const now = sample.arms[arm];
  const length = (vector: readonly number[] | null | undefined): number =>
    vector == null ? NaN : norm(vector.slice(0, 3));
  return [length(now?.wrench), length(now?.velocity), length(now?.commanded)];
}
