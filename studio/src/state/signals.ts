// What is plotted: the force and the speed of each arm live, or what is recorded of an operation that was not seen live.
import { computed, effect, signal } from "@preact/signals";
import { api, ApiError } from "../api/client";
import { PlotColumns } from "../recording/plot_columns";
import { ArmMeter, Series, type Line } from "./series";
import { isOngoing, live, operationId, replay, sample, status } from "./studio";
import { localName } from "./text";

const CAPACITY = 6000;

/** Lines and their columns, the time in s first. */
export interface Plotted {
  lines: readonly Line[];
  columns: readonly (number | null)[][];
}

interface Measuring {
  arms: readonly string[];
  series: Series;
  meters: readonly ArmMeter[];
}

let measuring: Measuring | null = null;
let lastTimeS = -Infinity;
const revision = signal(0);
const liveLines = signal<readonly Line[]>([]);
/** The operations whose first samples have come while the page was open. */
const seen = new Set<string>();

/** What a recording that is played has. */
export const recorded = signal<Plotted | null>(null);
/** What is recorded of the operation that is shown, if it was not seen live. */
const stored = signal<Plotted | null>(null);
/** Whether that is being read. */
export const isReadingStored = signal(false);

const shown = computed(() => (replay.value === null ? stored.value : recorded.value));
export const plotLines = computed(
  () => shown.value?.lines ?? (replay.value === null && !isReadingStored.value ? liveLines.value : []),
);

/** The columns to plot, the time first: those of the operation that is shown. */
export const plotColumns = computed(() => {
  if (shown.value !== null) return shown.value.columns;
  if (revision.value === 0 || replay.value !== null) return [];
  const columns = measuring?.series.columns() ?? [];
  const { task, ended } = live.value;
  return task === null ? columns : between(columns, task.time, ended?.time ?? Infinity);
});

/** Return the rows of columns whose times are in a span; all if there are none. */
export function between(columns: (number | null)[][], from: number, to: number): (number | null)[][] {
  const times = columns[0] ?? [];
  const first = times.findIndex((each) => (each ?? 0) >= from);
  const end = times.findLastIndex((each) => (each ?? 0) <= to);
  return first < 0 || end < first ? columns : columns.map((each) => each.slice(first, end + 1));
}

/** Begin to measure the samples that come; the function that is returned ends that. */
export function measureSamples(): () => void {
  const ends = [effect(takeSample), effect(readStored)];
  return () => ends.forEach((end) => end());
}

function takeSample(): void {
  const now = sample.value;
  if (now === null) {
    measuring = null;
    seen.clear();
    return;
  }
  if (now.time_s < lastTimeS) measuring = null; // The cell was reset, and its clock with it.
  lastTimeS = now.time_s;
  const arms = Object.keys(now.arms).sort();
  if (measuring?.arms.join() !== arms.join()) begin(arms);
  const current = measuring;
  if (current === null) return;
  const values = arms.flatMap((arm, index) => current.meters[index]?.measure(now, arm) ?? []);
  current.series.add(now.time_s, values);
  const begun = status.peek();
  if (begun !== null && ["queued", "planning", "planned"].includes(begun.state)) seen.add(begun.id);
  revision.value = revision.peek() + 1;
}

function begin(arms: readonly string[]): void {
  const lines = armLines(arms.map(localName));
  measuring = { arms, series: new Series(lines, CAPACITY), meters: arms.map(() => new ArmMeter()) };
  liveLines.value = lines;
}

/** Return the lines of arms: their names only where there are several. */
export function armLines(arms: readonly string[]): Line[] {
  const name = (what: string, arm: string): string => (arms.length === 1 ? what : `${what} ${arm}`);
  return arms.flatMap((arm) => [
    { name: name("force", arm), unit: "N" },
    { name: name("speed", arm), unit: "m/s" },
  ]);
}

/** Read what is recorded of an operation that has ended and was not seen from its beginning. */
function readStored(): void {
  const id = operationId.value;
  stored.value = null;
  isReadingStored.value = id !== null && !isOngoing.value && status.value !== null && !seen.has(id);
  if (id === null || !isReadingStored.peek()) return;
  void readSignals(id)
    .then(
      (found) => {
        if (operationId.peek() === id) stored.value = found;
      },
      (error: unknown) => {
        if (!(error instanceof ApiError)) throw error;
      },
    )
    .finally(() => {
      if (operationId.peek() === id) isReadingStored.value = false;
    });
}

/** Read the recorded forces of an operation; null if it has none. */
export async function readSignals(id: string): Promise<Plotted | null> {
  let plot: PlotColumns | null = null;
  let after: number | null = null;
  for (let more = true; more;) {
    const page = await api.signals(id, "force_,contact_force,tool_v", after);
    plot ??= new PlotColumns(page.signals);
    plot.add(page.time_s, page.columns);
    [more, after] = [page.more && page.time_s.length > 0, page.time_s.at(-1) ?? null];
  }
  return plot === null || plot.lines.length === 0 ? null : plot;
}
