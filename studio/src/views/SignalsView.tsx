// Signals: force and speed over time, with the span of the selection; a click selects a moment.
import { useEffect, useRef } from "preact/hooks";
import { effect, signal, type Signal } from "@preact/signals";
import type uPlot from "uplot";
import { shortNames } from "../state/series";
import { drawSvg, writeCsv } from "../state/signal_files";
import {
  allLines,
  chosenDevice,
  chosenKind,
  isReadingStored,
  namesOf,
  plotColumns,
  plotLines,
} from "../state/signals";
import { select } from "../state/actions";
import { replay, span } from "../state/studio";
import { GanttView } from "./GanttView";
import { TabbedPanel } from "./Panel";
import { isDark, signalsTab } from "./layout";
import { drawPlot, fitPlot } from "./plot";

const pausedAt = signal(false);

export function SignalsView() {
  return (
    <TabbedPanel
      name="signals"
      title="Signals and plan"
      active={signalsTab.value}
      onChoose={(id) => (signalsTab.value = id as typeof signalsTab.value)}
      tabs={[
        { id: "signals", title: "Signals", view: () => <Signals /> },
        { id: "plan", title: "Plan over time", view: () => <GanttView /> },
      ]}
    />
  );
}

/** Say why there is no plot. */
function describeNothing(): string {
  if (replay.value !== null) return "This recording has no forces or speeds of an arm.";
  return isReadingStored.value ? "The recorded signals are read …" : "No arm of this cell is measured yet.";
}

function Signals() {
  return (
    <div class="signals">
      <Tools />
      <Plots />
    </div>
  );
}

function Tools() {
  if (allLines.value.length === 0) return null;
  return (
    <div class="row signal-tools">
      <Choice
        label="Which arm or tool"
        every="all devices"
        chosen={chosenDevice}
        options={allLines.value.map((each) => each.of)}
      />
      <Choice
        label="Which kind of signal"
        every="all signals"
        chosen={chosenKind}
        options={allLines.value.map((each) => each.kind)}
      />
      <button class="plain small" title="Save what is plotted as a table" onClick={saveCsv}>
        CSV
      </button>
      <button class="plain small" title="Save what is plotted as a drawing" onClick={saveSvg}>
        SVG
      </button>
      <label class="row small" title="Keep the plot still, to look at it">
        <input type="checkbox" checked={pausedAt.value} onChange={() => (pausedAt.value = !pausedAt.value)} />
        hold
      </label>
    </div>
  );
}

/** A choice among the values that lines have; without several there is none. */
function Choice(of: { label: string; every: string; chosen: Signal<string>; options: readonly string[] }) {
  const options = [...new Set(of.options)];
  if (options.length < 2) return null;
  return (
    <select
      class="small"
      aria-label={of.label}
      value={options.includes(of.chosen.value) ? of.chosen.value : ""}
      onChange={(event) => (of.chosen.value = event.currentTarget.value)}
    >
      <option value="">{of.every}</option>
      {options.map((each) => (
        <option key={each} value={each}>
          {each}
        </option>
      ))}
    </select>
  );
}

function saveCsv(): void {
  saveFile("signals.csv", "text/csv", writeCsv({ lines: plotLines.peek(), columns: plotColumns.peek() }));
}

function saveSvg(): void {
  const columns = plotColumns.peek();
  const [times = []] = columns;
  const range = shownRange ?? [times[0] ?? 0, times.at(-1) ?? 0];
  saveFile("signals.svg", "image/svg+xml", drawSvg({ lines: plotLines.peek(), columns }, range));
}

/** The times between which the plot shows signals. */
let shownRange: [number, number] | null = null;

function rangeOf(plot: uPlot): [number, number] | null {
  const { min, max } = plot.scales.x ?? {};
  return min == null || max == null ? null : [min, max];
}

function saveFile(name: string, type: string, text: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}

function Plots() {
  const box = useRef<HTMLDivElement>(null);
  const lines = plotLines.value;
  const key = namesOf(lines);
  useEffect(() => {
    const element = box.current;
    if (element === null || lines.length === 0) return;
    let plot: uPlot | null = null;
    let isOver = false;
    let end = (): void => undefined;
    const names = shortNames(lines);
    void drawPlot(
      element,
      lines.map((each, at) => ({ ...each, name: names[at] ?? each.name })),
      (time) => select({ kind: "time", time }),
      () => span.peek(),
    ).then((made) => {
      if (isOver) return made.destroy();
      plot = made;
      fitPlot(made, element);
      made.over.addEventListener("pointerup", () => window.setTimeout(() => (shownRange = rangeOf(made))));
      end = effect(() => {
        const columns = plotColumns.value;
        // Lines came or went, and so did columns: they are those of the plot that replaces this one.
        if (namesOf(plotLines.value) !== key) return;
        if (!pausedAt.value || made.data[0].length === 0) made.setData(columns as uPlot.AlignedData);
        shownRange = rangeOf(made);
      });
    });
    const ofSpan = span.subscribe(() => plot?.redraw(false));
    const observer = new ResizeObserver(() => plot !== null && fitPlot(plot, element));
    observer.observe(element);
    return () => {
      isOver = true;
      observer.disconnect();
      ofSpan();
      end();
      plot?.destroy();
    };
  }, [key, isDark.value]);
  if (lines.length === 0) return <div class="empty">{describeNothing()}</div>;
  return (
    <div
      class="plots"
      ref={box}
      role="img"
      aria-label={`Plot of ${lines.map((each) => each.name).join(", ")}`}
    />
  );
}
