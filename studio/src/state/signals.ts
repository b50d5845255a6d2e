// What is plotted: a line for the force and one for the speed of each arm, from samples live or of a recording.
import { computed, effect, signal } from "@preact/signals";
import { localName } from "./text";
import { ArmMeter, Series, type Line } from "./series";
import { replay, sample } from "./studio";

const CAPACITY = 6000;

interface Measuring {
  arms: readonly string[];
  series: Series;
  meters: readonly ArmMeter[];
}

let measuring: Measuring | null = null;
const revision = signal(0);
const liveLines = signal<readonly Line[]>([]);

/** The lines of a recording that is played, with their columns. */
export const recorded = signal<{ lines: readonly Line[]; columns: (number | null)[][] } | null>(null);

export const plotLines = computed(() =>
  replay.value === null ? liveLines.value : (recorded.value?.lines ?? []),
);

/** The columns to plot, the time first. */
export const plotColumns = computed(() => {
  if (revision.value < 0) return [];
  if (replay.value !== null) return recorded.value?.columns ?? [];
  return measuring?.series.columns() ?? [];
});

/** Begin to measure the samples that come; the function that is returned ends that. */
export function measureSamples(): () => void {
  return effect(() => {
    const now = sample.value;
    if (now === null) {
      measuring = null;
      return;
    }
    const arms = Object.keys(now.arms).sort();
    if (measuring?.arms.join() !== arms.join()) begin(arms);
    const current = measuring;
    if (current === null) return;
    current.series.add(
      now.time_s,
      arms.flatMap((arm, index) => current.meters[index]?.measure(now, arm) ?? []),
    );
    revision.value = revision.peek() + 1;
  });
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
