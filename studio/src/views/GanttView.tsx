// The plan over time: a row for each step and each device, as planned and as it happens, with a line that is now.
import { computed, signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { api } from "../api/client";
import type { PlanPreview } from "../api/types";
import { attempt as tryTo, select } from "../state/actions";
import {
  busyDevices,
  ganttOf,
  ganttOfPreview,
  ticksOf,
  type Gantt,
  type GanttStep,
  type Span,
} from "../state/gantt";
import type { OperationState } from "../state/operation";
import {
  cell,
  cellName,
  library,
  operation,
  preview,
  replay,
  selection,
  shownRun,
  shownTime,
} from "../state/studio";
import { formatTime } from "../state/text";
import { LeftOutParts } from "./LeftOutParts";
import { NodeMark } from "./status";

/** Labels of the devices of a cell by IRI. */
const devices = signal<{ cell: string; labels: ReadonlyMap<string, string> }>({
  cell: "",
  labels: new Map(),
});

const knowledge = computed(() => ({
  devices: devices.value.labels,
  durations: new Map(
    (library.value?.skills ?? []).flatMap((each) =>
      each.duration_s == null ? [] : [[each.name, each.duration_s] as const],
    ),
  ),
}));

export function GanttView() {
  const name = cellName.value;
  const isOn = cell.value !== null && cell.value.state !== "off";
  useEffect(() => {
    if (name === null || !isOn || devices.value.cell === name) return;
    void tryTo(async () => {
      const found = await api.devices(name);
      devices.value = { cell: name, labels: new Map(found.map(({ device }) => [device.iri, device.label])) };
    });
  }, [name, isOn]);
  const chosen = replay.value === null ? preview.value : null;
  return chosen?.status === "solved" ? <PlanOfChosen chosen={chosen} /> : <PlanOfRun />;
}

/** The plan of what is chosen, before it is started. */
function PlanOfChosen({ chosen }: { chosen: PlanPreview }) {
  if (chosen.plan.length === 0) return <div class="empty">Nothing to do: the goal holds already.</div>;
  return (
    <div class="gantt" role="group" aria-label="Plan over time" tabIndex={0}>
      <p class="row small gantt-note">
        <NodeMark status="pending" /> The plan of what is chosen; it has not been started.
      </p>
      <Chart gantt={ganttOfPreview(chosen, knowledge.value)} />
    </div>
  );
}

function PlanOfRun() {
  const state = operation.value;
  const last = state.attempts.findLast((each) => each.plan !== null);
  if (last?.plan == null) return <div class="empty">{whyEmpty(state)}</div>;
  const now = shownRun.value?.goesOn === true ? shownTime.value : null;
  const gantt = ganttOf(state, last, now, knowledge.value);
  if (gantt === null) return null;
  return (
    <div class="gantt" role="group" aria-label="Plan over time" tabIndex={0}>
      <Chart gantt={gantt} />
      <LeftOutParts plan={last.plan} arrived={last.arrived} />
      {state.attempts.length > 1 && (
        <p class="small muted">
          Plan {state.attempts.length}; the one before was replaced: {state.attempts.at(-2)?.reason}
        </p>
      )}
    </div>
  );
}

function whyEmpty(state: OperationState): string {
  if (state.state === "planning") return "It is being planned. The plan appears here with its devices.";
  if (state.nodes.size > 0) return "This task has a body, and no plan: the tree shows how far it is.";
  return "The plan of what runs appears here: each step and device over time.";
}

/** From where in percent of the chart a tick has no label: there is no room for it. */
const LAST_LABEL = 90;

function Chart({ gantt }: { gantt: Gantt }) {
  const busy = busyDevices(gantt);
  const at = (time: number): number => ((time - gantt.from) / (gantt.to - gantt.from)) * 100;
  return (
    <div class="gantt-chart">
      <div class="gantt-row gantt-axis" aria-hidden="true">
        <span />
        <span class="gantt-track">
          {ticksOf(gantt, 6).map((each) => (
            <span key={each} class="gantt-tick" style={{ left: `${at(each)}%` }}>
              {at(each) > LAST_LABEL ? "" : `${Number(each.toPrecision(6))} s`}
            </span>
          ))}
        </span>
      </div>
      <ol aria-label="Steps over time">
        {gantt.steps.map((each, index) => (
          <StepRow key={index} step={each} at={at} now={gantt.now} />
        ))}
      </ol>
      {busy.length > 0 && (
        <>
          <h3 class="gantt-heading">Devices</h3>
          <ul aria-label="Devices over time">
            {busy.map(([device, steps]) => (
              <li key={device} class="gantt-row">
                <span class="truncate mono" title={device}>
                  {device}
                </span>
                <span class="gantt-track">
                  {steps.map((each, index) => (
                    <Bars key={index} step={each} at={at} />
                  ))}
                  <Now at={at} now={gantt.now} />
                </span>
              </li>
            ))}
          </ul>
        </>
      )}
    </div>
  );
}

interface StepRowProps {
  step: GanttStep;
  at: (time: number) => number;
  now: number | null;
}

function StepRow({ step, at, now }: StepRowProps) {
  const { key, ran, planned } = step;
  const isSelected = key !== null && selection.value.kind === "node" && selection.value.key === key;
  return (
    <li>
      <button
        class={`gantt-row gantt-step ${isSelected ? "is-selected" : ""}`}
        disabled={key === null}
        title={`${step.name} ${step.values}\nplanned: ${describeSpan(planned)}\n${ran === null ? "it has not started" : `ran: ${describeSpan(ran)}`}`}
        onClick={() => key !== null && select({ kind: "node", key })}
      >
        <span class="row gantt-name">
          <NodeMark status={step.status} />
          <span class="truncate">
            {step.name} <span class="muted small">{step.values}</span>
          </span>
        </span>
        <span class="gantt-track">
          <Bars step={step} at={at} />
          <Now at={at} now={now} />
        </span>
      </button>
    </li>
  );
}

const describeSpan = ({ from, to }: Span): string =>
  `${formatTime(to - from)} from ${formatTime(from)} to ${formatTime(to)}`;

function Bars({ step, at }: { step: GanttStep; at: (time: number) => number }) {
  const style = ({ from, to }: Span) => ({
    left: `${at(from)}%`,
    width: `${Math.max(0.4, at(to) - at(from))}%`,
  });
  return (
    <>
      <span class="gantt-planned" style={style(step.planned)} />
      {step.ran !== null && <span class={`gantt-ran is-${step.status}`} style={style(step.ran)} />}
    </>
  );
}

function Now({ at, now }: { at: (time: number) => number; now: number | null }) {
  return now === null ? null : <span class="gantt-now" style={{ left: `${Math.min(100, at(now))}%` }} />;
}
