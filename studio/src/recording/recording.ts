// Reads the recording of an operation, an MCAP file: its events, and the signals that are plotted.
import { McapStreamReader, type McapTypes } from "@mcap/core";
import { decode } from "@msgpack/msgpack";
import { decompress } from "fzstd";
import type { Envelope } from "../api/types";
import type { SignalLine } from "../state/series";
import { Film } from "./film";
import { PlotColumns } from "./plot_columns";
import { decodeColumn, type SignalBlock } from "./signal_block";

export interface Recording {
  envelopes: Envelope[];
  /** What is plotted, with its columns, the time in s first. */
  lines: SignalLine[];
  columns: (number | null)[][];
  film: Film;
}

/** How long one point of a plot is, in ns: more would not be seen. */
const POINT_NS = 20_000_000;

/** Return what a file has, as far as it is complete; an error if it is no recording. */
export function readRecording(content: ArrayBuffer): Recording {
  const reader = new McapStreamReader({
    decompressHandlers: { zstd: (data, size) => decompress(data, new Uint8Array(Number(size))) },
  });
  const channels = new Map<number, McapTypes.Channel>();
  const parts = new Parts();
  reader.append(new Uint8Array(content));
  for (let record = reader.nextRecord(); record !== undefined; record = reader.nextRecord()) {
    if (record.type === "Channel") channels.set(record.id, record);
    const channel = record.type === "Message" ? channels.get(record.channelId) : undefined;
    if (record.type === "Message" && channel !== undefined) parts.take(channel, record);
  }
  return parts.finish();
}

/** What the messages of a recording have said so far. */
class Parts {
  private readonly envelopes: Envelope[] = [];
  private readonly film = new Film();
  private plot: PlotColumns | null = null;

  take(channel: McapTypes.Channel, { data, logTime }: McapTypes.TypedMcapRecords["Message"]): void {
    switch (channel.topic) {
      case "/events":
        this.envelopes.push(JSON.parse(new TextDecoder().decode(data)) as Envelope);
        break;
      case "/frames":
        this.film.addFrame(Number(logTime) / 1e9, data);
        break;
      case "/forces":
        this.film.addForces(data);
        break;
      case "/signals":
        this.plot ??= new PlotColumns(readDictionary(channel));
        addBlock(this.plot, decode(data) as SignalBlock);
    }
  }

  finish(): Recording {
    if (this.envelopes.length === 0) throw new Error("the file has no events of a run");
    this.envelopes.sort((one, other) => one.sequence - other.sequence);
    const { lines, columns } = this.plot ?? { lines: [], columns: [] };
    return { envelopes: this.envelopes, lines, columns, film: this.film };
  }
}

function readDictionary(channel: McapTypes.Channel): { column: string }[] {
  return JSON.parse(channel.metadata.get("signals") ?? "[]") as { column: string }[];
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
