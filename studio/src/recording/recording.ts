// Reads the recording of an operation, an MCAP file: its events, and the signals that are plotted.
import { McapStreamReader, type McapTypes } from "@mcap/core";
import { decode } from "@msgpack/msgpack";
import { decompress } from "fzstd";
import type { Envelope } from "../api/types";
import type { Line } from "../state/series";
import { decodeColumn, type SignalBlock } from "./signal_block";

export interface Recording {
  envelopes: Envelope[];
  /** What is plotted, with its columns, the time in s first. */
  lines: Line[];
  columns: (number | null)[][];
}

interface RecordedSignal {
  column: string;
  device: string;
  origin: string;
  unit: string;
}

/** How long one point of a plot is, in ns: more would not be seen. */
const POINT_NS = 20_000_000;
const EVENTS = "/events";
const SIGNALS = "/signals";

/** Return what a file has, as far as it is complete; an error if it is no recording. */
export function readRecording(content: ArrayBuffer): Recording {
  const reader = new McapStreamReader({
    decompressHandlers: { zstd: (data, size) => decompress(data, new Uint8Array(Number(size))) },
  });
  const channels = new Map<number, McapTypes.Channel>();
  const envelopes: Envelope[] = [];
  let plot: Plot | null = null;
  const text = new TextDecoder();
  reader.append(new Uint8Array(content));
  for (let record = reader.nextRecord(); record !== undefined; record = reader.nextRecord()) {
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type !== "Message") continue;
    const channel = channels.get(record.channelId);
    if (channel?.topic === EVENTS) envelopes.push(JSON.parse(text.decode(record.data)) as Envelope);
    if (channel?.topic === SIGNALS) {
      plot ??= new Plot(JSON.parse(channel.metadata.get("signals") ?? "[]") as RecordedSignal[]);
      plot.add(decode(record.data) as SignalBlock);
    }
  }
  if (envelopes.length === 0) throw new Error("the file has no events of a run");
  envelopes.sort((one, other) => one.sequence - other.sequence);
  return { envelopes, lines: plot?.lines ?? [], columns: plot?.columns ?? [] };
}

/** Collects the columns that are plotted: the length of forces, and contact forces, thinned. */
class Plot {
  readonly lines: Line[] = [];
  readonly columns: (number | null)[][] = [[]];
  private readonly sources: number[][] = [];

  constructor(signals: readonly RecordedSignal[]) {
    signals.forEach((each, at) => {
      const [device = "", , quantity = ""] = each.column.split("/");
      if (quantity === "contact_force_n") this.take(`contact of ${device}`, [at]);
      if (quantity === "force_x_n") this.take(`force at ${device}`, [at, at + 1, at + 2]);
    });
  }

  add(block: SignalBlock): void {
    const step = Math.max(1, Math.round(POINT_NS / block.period_ns));
    const needed = new Map(this.sources.flat().map((at) => [at, this.decode(block, at)]));
    for (let row = 0; row < block.rows; row += step) {
      this.columns[0]?.push((block.first_ns + row * block.period_ns) / 1e9);
      this.sources.forEach((source, line) => {
        const value = Math.hypot(...source.map((at) => needed.get(at)?.[row] ?? NaN));
        this.columns[line + 1]?.push(Number.isNaN(value) ? null : value);
      });
    }
  }

  private decode(block: SignalBlock, at: number): Float64Array {
    const column = block.columns[at];
    return column === undefined ? new Float64Array(0) : decodeColumn(column, block.rows);
  }

  private take(name: string, source: number[]): void {
    this.lines.push({ name, unit: "N" });
    this.sources.push(source);
    this.columns.push([]);
  }
}
