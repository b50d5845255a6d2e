// Signals: force and speed over time, with the span of the selection; a click selects a moment.
import { useEffect, useRef } from "preact/hooks";
import { effect, signal } from "@preact/signals";
import type uPlot from "uplot";
import { isReadingStored, plotColumns, plotLines } from "../state/signals";
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
      tools={signalsTab.value === "signals" && <Tools />}
      tabs={[
        { id: "signals", title: "Signals", view: () => <Plots /> },
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

function Tools() {
  return (
    <label class="row small" title="Keep the plot still, to look at it">
      <input type="checkbox" checked={pausedAt.value} onChange={() => (pausedAt.value = !pausedAt.value)} />
      hold
    </label>
  );
}

function Plots() {
  const box = useRef<HTMLDivElement>(null);
  const lines = plotLines.value;
  const key = `${lines.map((each) => each.name).join("|")} ${isDark.value}`;
  useEffect(() => {
    const element = box.current;
    if (element === null || lines.length === 0) return;
    let plot: uPlot | null = null;
    let isOver = false;
    let end = (): void => undefined;
    void drawPlot(
      element,
      lines,
      (time) => select({ kind: "time", time }),
      () => span.peek(),
    ).then((made) => {
      if (isOver) return made.destroy();
      plot = made;
      fitPlot(made, element);
      end = effect(() => {
        const columns = plotColumns.value;
        if (!pausedAt.value) made.setData(columns as uPlot.AlignedData);
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
  }, [key]);
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
