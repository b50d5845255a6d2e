// Trials: a task that is run many times in simulation; its series with how far each is, and a form for another one.
import { useEffect, useState } from "preact/hooks";
import type { TrialSeries, TrialsRequest } from "../api/types";
import { cellName, library, may } from "../state/studio";
import { formatStart } from "../state/run_times";
import {
  allSeries,
  beginSeries,
  describeDisturbance,
  DISTURBANCES,
  followSeries,
  goesOn,
  showSeries,
  wantedTrials,
} from "../state/trials";
import { GoalInput } from "./GoalInput";

export function TrialsView() {
  const cell = cellName.value;
  const [isAdding, setIsAdding] = useState(false);
  useEffect(() => {
    allSeries.value = null;
    return cell === null ? undefined : followSeries(cell);
  }, [cell]);
  const found = allSeries.value;
  return (
    <div class="runs">
      <div class="view-tools row">
        <span class="grow small muted">Simulated from the scene; the cell does nothing.</span>
        <button
          disabled={!may("operate") || library.value === null}
          title={may("operate") ? "Run a task many times in simulation" : "This needs the role operate"}
          aria-expanded={isAdding}
          onClick={() => setIsAdding(!isAdding)}
        >
          New series
        </button>
      </div>
      {isAdding && <NewSeries onDone={() => setIsAdding(false)} />}
      <div class="scroll">
        {found === null ? (
          <div class="empty">
            <span class="spinner" />
            Reading the series
          </div>
        ) : found.length === 0 ? (
          <div class="empty">
            No trials yet. A series runs one task with many seeds, and shows how its results are distributed.
          </div>
        ) : (
          <ul>
            {found.map((each) => (
              <Row key={each.id} series={each} />
            ))}
          </ul>
        )}
      </div>
    </div>
  );
}

function Row({ series }: { series: TrialSeries }) {
  const { request, done, passed } = series;
  const given = Object.values(request.arguments ?? {}).join(", ");
  const disturbance = describeDisturbance(series);
  const failed = done - passed;
  return (
    <li class="run-item">
      <button class="run-show series" title={series.id} onClick={() => void showSeries(series)}>
        <span class="row spread">
          <strong class="truncate">{request.task}</strong>
          <span class={`small ${failed > 0 ? "is-bad" : "is-good"}`}>
            {done === 0 ? "" : failed === 0 ? `✓ ${passed} passed` : `✗ ${failed} of ${done} failed`}
          </span>
        </span>
        {given !== "" && <span class="mono wrap-anywhere">{given}</span>}
        {disturbance !== "" && <span class="small wrap-anywhere">{disturbance}</span>}
        <span class="muted small">
          {formatStart(series)} · {goesOn(series) ? `${series.state}: ` : ""}
          {done} of {wantedTrials(series)} trials
        </span>
        {goesOn(series) && (
          <progress aria-label="Trials that are done" max={wantedTrials(series)} value={done} />
        )}
        {series.reason !== "" && <span class="small is-bad run-failure">{series.reason}</span>}
      </button>
    </li>
  );
}

function NewSeries({ onDone }: { onDone: () => void }) {
  const tasks = library.value?.tasks ?? [];
  const [name, setName] = useState("");
  const task = tasks.find((each) => each.name === name) ?? tasks[0];
  const [values, setValues] = useState<Record<string, string>>({});
  const [number, setNumber] = useState(20);
  const [disturb, setDisturb] = useState<keyof typeof DISTURBANCES>("none");
  const inputs = (task?.parameters ?? []).filter(
    (each) => each.direction === "in" || each.direction === "opt",
  );
  if (task === undefined) return <p class="edit-form muted">The library of this cell has no tasks.</p>;
  const isComplete = inputs.every((each) => each.direction === "opt" || (values[each.name] ?? "") !== "");
  const submit = async (event: Event): Promise<void> => {
    event.preventDefault();
    const given = inputs.map((each) => [each.name, values[each.name] ?? ""] as const);
    const request: TrialsRequest = {
      task: task.name,
      arguments: Object.fromEntries(given.filter(([, value]) => value !== "")),
      number,
      disturb,
    };
    if (await beginSeries(request)) onDone();
  };
  return (
    <form class="edit-form stack" onSubmit={(event) => void submit(event)}>
      <label class="stack">
        <span class="small muted">Task</span>
        <select aria-label="Task" value={task.name} onChange={(event) => setName(event.currentTarget.value)}>
          {tasks.map((each) => (
            <option key={each.name} value={each.name}>
              {each.name}
            </option>
          ))}
        </select>
      </label>
      {inputs.map((each) => (
        <GoalInput
          key={each.name}
          label={each.name}
          placeholder={`${each.name}: ${each.type}`}
          value={values[each.name] ?? ""}
          onChange={(value) => setValues({ ...values, [each.name]: value })}
        />
      ))}
      <div class="row">
        <label class="stack number-field">
          <span class="small muted">Trials</span>
          <input
            type="number"
            aria-label="Trials"
            min={1}
            max={1000}
            value={number}
            onInput={(event) => setNumber(event.currentTarget.valueAsNumber)}
          />
        </label>
        <label class="stack grow">
          <span class="small muted">Disturbed by</span>
          <select
            value={disturb}
            onChange={(event) => setDisturb(event.currentTarget.value as keyof typeof DISTURBANCES)}
          >
            {Object.entries(DISTURBANCES).map(([key, label]) => (
              <option key={key} value={key}>
                {label}
              </option>
            ))}
          </select>
        </label>
      </div>
      <div class="row">
        <button class="primary" disabled={!isComplete || !(number >= 1)}>
          Begin
        </button>
        <button type="button" onClick={onDone}>
          Cancel
        </button>
      </div>
    </form>
  );
}
