// Which recorded signals are plotted: the lengths of forces and speeds, as measured and as commanded, and contact forces.
import { makeLine, type Kind, type SignalLine } from "../state/series";

type Columns = readonly (ArrayLike<number | null> | undefined)[];

export class PlotColumns {
  readonly lines: SignalLine[] = [];
  /** The time in s, then a column for each line; null where a value is not known. */
  readonly columns: (number | null)[][] = [[]];
  /** The numbers of the signals that each line is the length of. */
  private readonly sources: number[][] = [];

  constructor(signals: readonly { column: string }[]) {
    signals.forEach(({ column }, at) => {
      const [device = "", origin = "", quantity = ""] = column.split("/");
      const vector = [at, at + 1, at + 2];
      const isCommand = origin === "command";
      if (quantity === "contact_force_n") this.take("contact", device, [at]);
      if (quantity === "force_x_n") this.take(isCommand ? "commanded force" : "force", device, vector);
      if (quantity === "face_vx_m_s") this.take("speed", device, vector);
      if (quantity === "tool_vx_m_s") this.take(isCommand ? "commanded speed" : "speed", device, vector);
    });
  }

  /** The numbers of all signals that are needed. */
  get needed(): ReadonlySet<number> {
    return new Set(this.sources.flat());
  }

  /** Add rows at times in s, every `step`-th of them. */
  add(times: ArrayLike<number>, columns: Columns, step = 1): void {
    for (let row = 0; row < times.length; row += step) {
      this.columns[0]?.push(times[row] ?? null);
      this.sources.forEach((source, line) => {
        const value = Math.hypot(...source.map((at) => columns[at]?.[row] ?? NaN));
        this.columns[line + 1]?.push(Number.isNaN(value) ? null : value);
      });
    }
  }

  private take(kind: Kind, of: string, source: number[]): void {
    this.lines.push(makeLine(kind, of));
    this.sources.push(source);
    this.columns.push([]);
  }
}
