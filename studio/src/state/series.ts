// Signals over time in a ring, for plots: columns of equal length with a common time.
import type { Sample } from "../api/types";
import { localName } from "./text";

/** A line of a plot: `unit` decides the axis; lines of the same `pair`, by default its name, have one colour. */
export interface Line {
  name: string;
  unit: string;
  pair?: string;
  isDashed?: boolean;
}

const KINDS = ["force", "commanded force", "contact", "speed", "commanded speed"] as const;
export type Kind = (typeof KINDS)[number];

/** A line that can be chosen by its kind, and by what it is of: an arm or a tool. */
export interface SignalLine extends Line {
  kind: Kind;
  of: string;
}

/** Return the line of a kind of signal of a device, called alike live and in recordings. */
export function makeLine(kind: Kind, of: string): SignalLine {
  const measured = kind.replace("commanded ", "");
  const unit = measured === "speed" ? "m/s" : "N";
  const name = `${kind} ${measured === "force" ? "at" : "of"} ${of}`;
  return { name, unit, pair: `${measured} ${of}`, isDashed: measured !== kind, kind, of };
}

/** Return the number of the colour of each line, from 0: those of a pair have the same one. */
export function colourLines(lines: readonly Line[]): number[] {
  const pairs = [...new Set(lines.map((each) => each.pair ?? each.name))];
  return lines.map((each) => pairs.indexOf(each.pair ?? each.name));
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

  /** Return a series with these lines and the rows of this one; what it does not have was not known. */
  withLines(lines: readonly SignalLine[]): Series {
    const grown = new Series(lines, this.capacity);
    const [times = [], ...columns] = this.columns();
    const own = lines.map(({ name }) => columns[this.lines.findIndex((each) => each.name === name)]);
    times.forEach((time, row) =>
      grown.push(
        time ?? NaN,
        own.map((each) => each?.[row] ?? NaN),
      ),
    );
    return grown;
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
function norm(vector: readonly number[]): number {
  return Math.hypot(...vector);
}

/** A line with its value now. */
export type Measured = readonly [line: SignalLine, value: number];

/**
 * Return what is plotted of a sample: of each arm the force at its wrist if it has a sensor, the force that it is to push with
 * while it pushes, and the speeds of its tool and of its reference; of each tool that is pressed, the force of its contacts.
 */
export function measure({ arms, forces = {} }: Sample): Measured[] {
  const [armNames, tools] = [Object.keys(arms).sort(), Object.keys(forces).sort()];
  const ofArms = armNames.flatMap((arm) => {
    const { wrench, commanded_force, velocity, commanded } = arms[arm] ?? {};
    const line = (kind: Kind, vector: readonly number[] | null | undefined): Measured[] =>
      vector == null ? [] : [[makeLine(kind, localName(arm)), norm(vector.slice(0, 3))]];
    return [
      ...line("force", wrench),
      ...line("commanded force", commanded_force),
      ...line("speed", velocity),
      ...line("commanded speed", commanded),
    ];
  });
  return [
    ...ofArms,
    ...tools.map((tool): Measured => [makeLine("contact", localName(tool)), norm(forces[tool]?.force ?? [])]),
  ];
}

/**
 * Return the numbers of lines in the order in which they are shown: by device, each from what it feels to how it moves. What is
 * commanded is drawn over what is measured, so tools come before arms.
 */
export function byDevice(lines: readonly SignalLine[]): number[] {
  const commanded = new Set(lines.filter((each) => each.isDashed).map((each) => each.of));
  const named = [...new Set(lines.map((each) => each.of))];
  const devices = [
    ...named.filter((each) => !commanded.has(each)),
    ...named.filter((each) => commanded.has(each)),
  ];
  const rank = ({ of, kind }: SignalLine): number => devices.indexOf(of) * KINDS.length + KINDS.indexOf(kind);
  const ranked = lines.map((each, index) => ({ index, rank: rank(each) }));
  return ranked.sort((one, other) => one.rank - other.rank).map((each) => each.index);
}

/** Return what lines are called beside each other: a device is named once. */
export function shortNames(lines: readonly SignalLine[]): string[] {
  return lines.map(({ of, kind }, at) => (lines[at - 1]?.of === of ? kind : `${of} ${kind}`));
}
