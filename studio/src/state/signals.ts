// What is plotted: forces and speeds of each arm live, and what is recorded of an operation where the page missed it.
import { computed, effect, signal } from "@preact/signals";
import { api, ApiError } from "../api/client";
import { PlotColumns } from "../recording/plot_columns";
import { between, continuePlot, dropEmpty, hasGaps, type Plotted } from "./plotted";
import { byDevice, measure, Series, type SignalLine } from "./series";
import { isOngoing, live, operationId, replay, sample, status } from "./studio";

const CAPACITY = 6000;
/** How far apart points of a plot are at least, in s, and how often the recording fills gaps, in ms. */
const POINT_S = 0.02;
const FILL_MS = 5000;
const NEEDED = "force_,contact_force,tool_v,face_v";

let measuring: Series | null = null;
let lastTimeS = -Infinity;
const revision = signal(0);
const liveLines = signal<readonly SignalLine[]>([]);

/** What a recording that is played has. */
export const recorded = signal<Plotted | null>(null);
/** What is recorded of the operation that is shown, as far as it was needed. */
const stored = signal<Plotted | null>(null);
/** Whether that is being read for the first time. */
export const isReadingStored = signal(false);

const liveColumns = computed((): (number | null)[][] => {
  if (revision.value === 0) return [];
  const { task, ended } = live.value;
  const columns = measuring?.columns() ?? [];
  if (task !== null) return between(columns, task.time, ended?.time ?? Infinity);
  return operationId.value === null ? columns : [];
});

const plotted = computed((): Plotted => {
  if (replay.value !== null) return dropEmpty(recorded.value ?? { lines: [], columns: [] });
  const own = { lines: liveLines.value, columns: liveColumns.value };
  return dropEmpty(stored.value === null ? own : continuePlot(stored.value, own));
});

/** Return the names of lines as one text, which is the same for the same lines. */
export const namesOf = (lines: readonly SignalLine[]): string => lines.map((each) => each.name).join();

let linesBefore: readonly SignalLine[] = [];
/** All lines that there are to choose from; the same array until they change. */
export const allLines = computed(() => {
  const { lines } = plotted.value;
  if (namesOf(lines) !== namesOf(linesBefore)) linesBefore = lines;
  return linesBefore;
});
/** What is chosen: a device, and a kind of signal; empty for all. */
export const chosenDevice = signal("");
export const chosenKind = signal("");
const shownIndices = computed(() =>
  byDevice(allLines.value).filter((index) => {
    const { of = "", kind = "" } = allLines.value[index] ?? {};
    return [chosenDevice.value || of, chosenKind.value || kind].join() === [of, kind].join();
  }),
);
export const plotLines = computed(() => shownIndices.value.flatMap((index) => allLines.value[index] ?? []));

/** The columns to plot, the time first: those of the lines that are chosen. */
export const plotColumns = computed(() => {
  const { columns } = plotted.value;
  return [columns[0] ?? [], ...shownIndices.value.map((index) => columns[index + 1] ?? [])];
});

/** Begin to measure the samples that come; the function that is returned ends that. */
export function measureSamples(): () => void {
  const ends = [effect(takeSample), effect(followStored)];
  return () => ends.forEach((end) => end());
}

function takeSample(): void {
  const now = sample.value;
  if (now === null) {
    measuring = null;
    return;
  }
  if (now.time_s < lastTimeS) measuring = null; // The cell was reset, and its clock with it.
  lastTimeS = now.time_s;
  const measured = measure(now);
  const series = extend(measured.map(([line]) => line));
  const values = new Map(measured.map(([line, value]) => [line.name, value]));
  // A tool that was pressed and is no longer has no force; what else is not there is not known.
  const value = ({ name, kind }: SignalLine): number => values.get(name) ?? (kind === "contact" ? 0 : NaN);
  series.add(now.time_s, series.lines.map(value));
  revision.value = revision.peek() + 1;
}

/** Measure these lines as well from now on; return what is measured. */
function extend(lines: readonly SignalLine[]): Series {
  const known = measuring?.lines ?? [];
  const added = lines.filter(({ name }) => known.every((each) => each.name !== name));
  if (measuring !== null && added.length === 0) return measuring;
  liveLines.value = [...known, ...added];
  measuring = measuring?.withLines(liveLines.value) ?? new Series(liveLines.value, CAPACITY);
  return measuring;
}

/** Fill from the recording of the operation that is shown what the page missed of it, until it has ended and all is read. */
function followStored(): () => void {
  const [id, ongoing] = [operationId.value, isOngoing.value];
  const isKnown = id !== null && hasStatus.value;
  if (stored.peek() !== null && reader?.id !== id) stored.value = null;
  if (!isKnown) return () => undefined;
  reader = reader?.id === id ? reader : new StoredReader(id);
  const current = reader;
  const fill = (): void => void current.fill(!ongoing);
  fill();
  const timer = ongoing ? window.setInterval(fill, FILL_MS) : 0;
  return () => window.clearInterval(timer);
}

const hasStatus = computed(() => status.value !== null);
let reader: StoredReader | null = null;

/** Reads the recorded signals of an operation on and on. */
class StoredReader {
  private isReading = false;
  private readonly pages: SignalPages;

  constructor(readonly id: string) {
    this.pages = new SignalPages(id);
  }

  /** Read what is recorded by now if the page has missed something; `all` if nothing is recorded later. */
  async fill(all: boolean): Promise<void> {
    if (this.isReading || !this.isNeeded(all)) return;
    this.isReading = true;
    isReadingStored.value = all && stored.peek() === null;
    try {
      const found = await this.pages.read();
      if (reader === this && found !== null) stored.value = found;
    } catch (error) {
      if (!(error instanceof ApiError)) throw error; // it has no recording, or none yet
    } finally {
      this.isReading = false;
      if (reader === this) isReadingStored.value = false;
    }
  }

  private isNeeded(all: boolean): boolean {
    if (all && stored.peek() !== null) return true;
    const since = stored.peek()?.columns[0]?.at(-1) ?? live.peek().task?.time ?? null;
    return since === null ? all : hasGaps(liveColumns.peek(), since);
  }
}

/** The recorded signals of an operation, read as far as they are written. */
class SignalPages {
  private plot: PlotColumns | null = null;
  private after: number | null = null;

  constructor(private readonly id: string) {}

  /** Read what has been written since; return all up to now, null if there is nothing to plot. */
  async read(): Promise<Plotted | null> {
    for (let more = true; more;) {
      const page = await api.signals(this.id, NEEDED, this.after, POINT_S);
      this.plot ??= new PlotColumns(page.signals);
      this.plot.add(page.time_s, page.columns);
      [more, this.after] = [page.more && page.time_s.length > 0, page.time_s.at(-1) ?? this.after];
    }
    const { plot } = this;
    return plot === null || plot.lines.length === 0 ? null : { lines: plot.lines, columns: plot.columns };
  }
}

/** Read the recorded forces and speeds of an operation; null if it has none. */
export function readSignals(id: string): Promise<Plotted | null> {
  return new SignalPages(id).read();
}
