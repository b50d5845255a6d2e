// Jobs: plans, rehearsals, trials, reports and learning, whoever has begun them; and a form for trials.
import { useEffect, useState } from "preact/hooks";
import { api } from "../api/client";
import type { Job, JobEvent, JobRequest } from "../api/types";
import { attempt } from "../state/actions";
import {
  beginJob,
  canRestart,
  goesOn,
  jobs,
  KINDS,
  LEARNED,
  previews,
  RECORDING,
  REPORT,
} from "../state/jobs";
import { replayJob } from "../state/replay";
import { cellName, library, may } from "../state/studio";
import { formatMoment, formatStart } from "../state/run_times";
import { describeDisturbance, DISTURBANCES, followSeries, showSeries, type Trials } from "../state/trials";
import { GoalInput } from "./GoalInput";

export function JobsView() {
  const cell = cellName.value;
  const [isAdding, setIsAdding] = useState(false);
  const all = jobs.value;
  useEffect(followSeries, [all]);
  const shown = [...all.values()].filter((each) => each.cell === cell && !previews.value.has(each.id));
  const found = shown.reverse();
  return (
    <div class="runs">
      <div class="view-tools row">
        <span class="grow small muted">Beside the cell, which does nothing.</span>
        <button
          disabled={!may("operate") || library.value === null}
          title={may("operate") ? "Run a task many times in simulation" : "This needs the role operate"}
          aria-expanded={isAdding}
          onClick={() => setIsAdding(!isAdding)}
        >
          New trials
        </button>
      </div>
      {isAdding && cell !== null && <NewTrials cell={cell} onDone={() => setIsAdding(false)} />}
      <div class="scroll">
        {found.length === 0 ? (
          <div class="empty">
            No jobs yet. Trials run one task with many seeds, and show how its results are distributed.
          </div>
        ) : (
          <ul>
            {found.map((each) => (
              <Row key={each.id} job={each} />
            ))}
          </ul>
        )}
      </div>
    </div>
  );
}

const isTrials = (job: Job): job is Trials => job.request.kind === "trials";

/** Return what a job is about. */
function subjectOf({ request }: Job): string {
  switch (request.kind) {
    case "plan":
      return request.task ?? request.goal ?? "";
    case "rehearsal":
      return request.task ?? request.goal ?? request.call ?? "";
    case "trials":
    case "learn":
      return request.task;
    case "trial-replay":
      return `seed ${request.seed} of ${request.trials}`;
    case "report":
      return request.operation;
  }
}

function Row({ job }: { job: Job }) {
  const about = (
    <>
      <span class="row spread">
        <strong class="truncate">
          {KINDS[job.request.kind]} <span class="muted">{subjectOf(job)}</span>
        </strong>
        <Verdict job={job} />
      </span>
      {isTrials(job) && <Given job={job} />}
      <span class="muted small">
        {formatStart(job)} · {job.owner} · {job.state}
        {job.wanted > 1 &&
          `: ${job.done} of ${job.wanted} ${job.request.kind === "learn" ? "candidates" : "trials"}`}
      </span>
      {goesOn(job) && <progress aria-label="What is done" max={job.wanted} value={job.done} />}
      {job.reason !== "" && <span class="small is-bad run-failure">{job.reason}</span>}
    </>
  );
  return (
    <li class="run-item">
      {isTrials(job) ? (
        <button class="run-show series" title={job.id} onClick={() => void showSeries(job)}>
          {about}
        </button>
      ) : (
        <div class="run-show series" title={job.id}>
          {about}
        </div>
      )}
      <Actions job={job} />
    </li>
  );
}

/** What came of the trials that are done. */
function Verdict({ job: { done, failed, request } }: { job: Job }) {
  if (request.kind !== "trials" || done === 0) return null;
  return (
    <span class={`small ${failed > 0 ? "is-bad" : "is-good"}`}>
      {failed === 0 ? `✓ ${done} passed` : `✗ ${failed} of ${done} failed`}
    </span>
  );
}

function Given({ job }: { job: Trials }) {
  const given = Object.values(job.request.arguments ?? {}).join(", ");
  const disturbance = describeDisturbance(job);
  return (
    <>
      {given !== "" && <span class="mono wrap-anywhere">{given}</span>}
      {disturbance !== "" && <span class="small wrap-anywhere">{disturbance}</span>}
    </>
  );
}

function Actions({ job }: { job: Job }) {
  const [log, setLog] = useState<readonly JobEvent[] | null>(null);
  const readLog = (): Promise<boolean> => attempt(async () => setLog(await api.jobEvents(job.id)));
  useEffect(() => {
    if (log !== null) void readLog();
  }, [job.state, job.done]);
  const isAllowed = may("operate") || job.request.kind === "plan";
  return (
    <>
      <div class="row run-actions">
        {job.files.includes(RECORDING) && (
          <button
            class="plain small"
            onClick={() => void attempt(() => replayJob(job, `${KINDS[job.request.kind]} ${subjectOf(job)}`))}
          >
            Play it
          </button>
        )}
        {[REPORT, LEARNED]
          .filter((each) => job.files.includes(each))
          .map((each) => (
            <a key={each} class="small" href={api.jobPage(job.id, each)} target="_blank" rel="noopener">
              Open report
            </a>
          ))}
        <button
          class="plain small"
          aria-expanded={log !== null}
          onClick={() => (log === null ? void readLog() : setLog(null))}
        >
          Log
        </button>
        {goesOn(job) && isAllowed && (
          <button class="plain small" onClick={() => void attempt(() => api.cancelJob(job.id))}>
            Cancel
          </button>
        )}
        {canRestart(job) && isAllowed && (
          <button class="plain small" onClick={() => void attempt(() => api.restartJob(job.id))}>
            Begin again
          </button>
        )}
        {!goesOn(job) && !isTrials(job) && isAllowed && (
          <button class="plain small" onClick={() => void attempt(() => api.removeJob(job.id))}>
            Forget
          </button>
        )}
      </div>
      {log !== null && (
        <ol class="small wrap-anywhere" aria-label="Log">
          {log.map((each) => (
            <li key={each.sequence}>
              <span class="muted">{formatMoment(new Date(each.wall_time_ns / 1e6))}</span> {each.message}
            </li>
          ))}
        </ol>
      )}
    </>
  );
}

function NewTrials({ cell, onDone }: { cell: string; onDone: () => void }) {
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
    const request: JobRequest = {
      kind: "trials",
      cell,
      task: task.name,
      arguments: Object.fromEntries(given.filter(([, value]) => value !== "")),
      number,
      disturb,
    };
    if (await attempt(() => beginJob(request))) onDone();
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
