// A signal that two runs have, one line for each, from the beginning of each run.
import { useEffect, useRef, useState } from "preact/hooks";
import type uPlot from "uplot";
import { overlay } from "../state/comparison";
import type { Plotted } from "../state/plotted";
import { isDark } from "./layout";
import { drawPlot } from "./plot";

export function ComparedSignals({ first, second }: { first: Plotted | null; second: Plotted | null }) {
  const [chosen, setChosen] = useState("");
  const names = (first?.lines ?? [])
    .map((each) => each.name)
    .filter((name) => second?.lines.some((each) => each.name === name));
  const name = names.includes(chosen) ? chosen : (names[0] ?? "");
  return (
    <section class="compared-signals" aria-label="Signals of both">
      <div class="row spread">
        <h3>Signals</h3>
        {names.length > 0 && (
          <label>
            <span class="visually-hidden">Which signal</span>
            <select value={name} onChange={(event) => setChosen(event.currentTarget.value)}>
              {names.map((each) => (
                <option key={each} value={each}>
                  {each}
                </option>
              ))}
            </select>
          </label>
        )}
      </div>
      {first === null || second === null || name === "" ? (
        <p class="small muted">
          {first === null && second === null
            ? "Neither run has recorded forces."
            : "The two runs have no recorded force in common."}
        </p>
      ) : (
        <OverlaidPlot name={name} first={first} second={second} />
      )}
    </section>
  );
}

function OverlaidPlot({ name, first, second }: { name: string; first: Plotted; second: Plotted }) {
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const element = box.current;
    const columns = overlay(name, first, second);
    if (element === null || columns === null) return;
    const unit = first.lines.find((each) => each.name === name)?.unit ?? "";
    let plot: uPlot | null = null;
    let isOver = false;
    const lines = [
      { name: "A", unit },
      { name: "B", unit, isDashed: true },
    ];
    void drawPlot(
      element,
      lines,
      () => undefined,
      () => null,
      true, // the rows of one run are not those of the other
    ).then((made) => {
      if (isOver) return made.destroy();
      plot = made;
      made.setData(columns as uPlot.AlignedData);
    });
    return () => {
      isOver = true;
      plot?.destroy();
    };
  }, [name, first, second, isDark.value]);
  return (
    <div class="compared-plot plots" ref={box} role="img" aria-label={`${name} of both runs over time`} />
  );
}
