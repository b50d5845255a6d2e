// Reads the recording of an operation, an MCAP file: its events, and the signals that are plotted.
import { McapStreamReader, type McapTypes } from "@mcap/core";
import { decode } from "@msgpack/msgpack";
import { decompress } from "fzstd";
import type { Envelope } from "../api/types";
import type { Line } from "../state/series";
import { PlotColumns } from "./plot_columns";
import { decodeColumn, type SignalBlock } from "./signal_block";

export interface Recording {
  envelopes: Envelope[];
  /** What is plotted, with its columns, the time in s first. */
  lines: Line[];
  columns: (number | null)[][];
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
  let plot: PlotColumns | null = null;
  const text = new TextDecoder();
  reader.append(new Uint8Array(content));
  for (let record = reader.nextRecord(); record !== undefined; record = reader.nextRecord()) {
    if (record.type === "Channel") channels.set(record.id, record);
    if (record.type !== "Message") continue;
    const channel = channels.get(record.channelId);
    if (channel?.topic === EVENTS) envelopes.push(JSON.parse(text.decode(record.data)) as Envelope);
    if (channel?.topic === SIGNALS) {
      plot ??= new PlotColumns(JSON.parse(channel.metadata.get("signals") ?? "[]") as { column: string }[]);
      addBlock(plot, decode(record.data) as SignalBlock);
    }
  }
  if (envelopes.length === 0) throw new Error("the file has no events of a run");
  envelopes.sort((one, other) => one.sequence - other.sequence);
  return { envelopes, lines: plot?.lines ?? [], columns: plot?.columns ?? [] };
}

/** Add the rows of a block to what is plotted, thinned. */
function addBlock(plot: PlotColumns, block: SignalBlock): void {
  const { needed } = plot;
  const times = Array.from(
    { length: block.rows },
    (_, row) => (block.first_ns + row * block.period_ns) / 1e9,
  );
  const columns = block.columns.map((each, at) =>
    needed.has(at) ? decodeColumn(each, block.rows) : undefined,
  );
  plot.add(times, columns, Math.max(1, Math.round(POINT_NS / block.period_ns)));
}
