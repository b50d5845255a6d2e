// Choosing what to do: a task of the library, or a goal; the plan is shown before anything moves.
import { useSignal } from "@preact/signals";
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type { PlanWish } from "../api/client";
import type { ParameterDescription, TaskDescription } from "../api/types";
import { start } from "../state/actions";
import { breakpoints } from "../state/source";
import { cell, facts, library, mayCommand, message, refusalOf, status } from "../state/studio";
import { individualsOf } from "../state/text";
import { GoalInput } from "./GoalInput";
import { wantedTask } from "./layout";
import { Preview } from "./Preview";
import { usePreview } from "./previewing";
import { Rehearse } from "./Rehearse";
import { type RunChoice, RunOptions } from "./RunOptions";

type Wish =
  { kind: "task"; task: TaskDescription; values: Record<string, string> } | { kind: "goal"; goal: string };

export function Choose({ onDone }: { onDone: () => void }) {
  const [wish, setWish] = useState<Wish | null>(null);
  const [name, tasks] = [wantedTask.value, library.value?.tasks];
  useEffect(() => {
    if (name === null || tasks === undefined) return;
    wantedTask.value = null;
    const task = tasks.find((each) => each.name === name);
    if (task !== undefined) setWish({ kind: "task", task, values: {} });
    else message.value = { kind: "error", text: `The skills of this cell have no task ${name}.` };
  }, [name, tasks]);
  if (library.value === null) return <LibraryMissing />;
  return (
    <div class="run stack">
      {status.value !== null && (
        <button class="link" onClick={onDone}>
          ‹ back to the operation
        </button>
      )}
      {wish === null ? (
        <Offers onChoose={setWish} />
      ) : (
        <Chosen wish={wish} onChange={setWish} onDone={onDone} />
      )}
    </div>
  );
}

function LibraryMissing() {
  const current = cell.value;
  return (
    <div class="empty">
      {current?.state === "off" && current.reason !== "it starts" && current.reason !== "" ? (
        <p class="notice bad">The cell is off: {current.reason}</p>
      ) : (
        <>
          <span class="spinner" />
          The cell starts, and its skills are checked
        </>
      )}
    </div>
  );
}

/** Return what a goal names that the world of the cell does not have. */
function missingIn(goal: string, known: ReadonlySet<string>): string[] {
  const names = goal.match(/(?<![\w-])[a-z][\w-]*:[A-Z][\w-]*/g) ?? [];
  return known.size === 0 ? [] : [...new Set(names)].filter((each) => !known.has(each));
}

function Offers({ onChoose }: { onChoose: (wish: Wish) => void }) {
  const [goal, setGoal] = useState("");
  const known = useMemo(
    () => new Set(facts.value.flatMap((each) => individualsOf(each.fact)).map((each) => each.label)),
    [facts.value],
  );
  // The order stays while a person reads, also if the world arrives after the library.
  const tasks = useMemo(() => {
    const all = library.value?.tasks ?? [];
    return [...all].sort(
      (one, other) => missingIn(one.goal, known).length - missingIn(other.goal, known).length,
    );
  }, [library.value]);
  const offers = tasks.map((task) => ({ task, missing: missingIn(task.goal, known) }));
  const example = tasks.find(({ goal }) => goal !== "")?.goal;
  return (
    <>
      <h3>What shall be done?</h3>
      {tasks.length === 0 && <p class="muted">The library of this cell has no tasks.</p>}
      <ul class="stack" aria-label="Tasks">
        {offers.map(({ task, missing }, index) => (
          <li key={task.name}>
            <button
              class="offer"
              title={
                missing.length > 0 ? `The world of this cell does not have ${missing.join(", ")}` : undefined
              }
              data-focus={index === 0 ? "" : undefined}
              onClick={() => onChoose({ kind: "task", task, values: {} })}
            >
              <strong>{task.name}</strong>
              <span class="muted small">{task.doc}</span>
              {missing.length > 0 && (
                <span class="small is-waiting">not in this cell: {missing.join(", ")}</span>
              )}
            </button>
          </li>
        ))}
      </ul>
      <form
        class="stack"
        onSubmit={(event) => {
          event.preventDefault();
          if (goal.trim() !== "") onChoose({ kind: "goal", goal: goal.trim() });
        }}
      >
        <h3>or a goal</h3>
        <GoalInput value={goal} onChange={setGoal} placeholder={example} />
        <button disabled={goal.trim() === ""}>Plan for this goal</button>
      </form>
    </>
  );
}

interface ChosenProps {
  wish: Wish;
  onChange: (wish: Wish | null) => void;
  onDone: () => void;
}

function Chosen({ wish, onChange, onDone }: ChosenProps) {
  const inputs =
    wish.kind === "task"
      ? wish.task.parameters.filter((each) => each.direction === "in" || each.direction === "opt")
      : [];
  const values = wish.kind === "task" ? wish.values : {};
  const isComplete =
    (wish.kind === "task" || wish.goal.trim() !== "") &&
    inputs.every((each) => each.direction === "opt" || (values[each.name] ?? "").trim() !== "");
  const request = toRequest(wish);
  return (
    <>
      <button class="link" onClick={() => onChange(null)}>
        ‹ all tasks
      </button>
      <h3>{wish.kind === "task" ? wish.task.name : "Goal"}</h3>
      {wish.kind === "task" && wish.task.doc !== "" && <p class="muted">{wish.task.doc}</p>}
      {wish.kind === "goal" && (
        <GoalInput value={wish.goal} onChange={(goal) => onChange({ kind: "goal", goal })} />
      )}
      {wish.kind === "task" && wish.task.goal !== "" && (
        <p class="small">
          until <code class="wrap-anywhere">{wish.task.goal}</code>
        </p>
      )}
      {wish.kind === "task" &&
        inputs.map((each) => (
          <ParameterInput
            key={each.name}
            parameter={each}
            value={values[each.name] ?? ""}
            onChange={(value) => onChange({ ...wish, values: { ...values, [each.name]: value } })}
          />
        ))}
      {isComplete ? (
        <PlanAndStart
          request={request}
          isPlanned={wish.kind === "goal" || wish.task.goal !== ""}
          onFix={(goal) => onChange({ kind: "goal", goal })}
          onDone={onDone}
        />
      ) : (
        <p class="muted small">Fill in the values to see the plan.</p>
      )}
    </>
  );
}

function toRequest(wish: Wish): PlanWish {
  if (wish.kind === "goal") return { goal: wish.goal };
  const given = Object.entries(wish.values).filter(([, value]) => value.trim() !== "");
  return { task: wish.task.name, arguments: Object.fromEntries(given) };
}

interface ParameterInputProps {
  parameter: ParameterDescription;
  value: string;
  onChange: (value: string) => void;
}

function ParameterInput({ parameter, value, onChange }: ParameterInputProps) {
  return (
    <label class="stack parameter">
      <span class="small">
        <span class="mono">{parameter.name}</span>{" "}
        <span class="muted">
          {parameter.type}
          {parameter.direction === "opt" ? ", optional" : ""}
        </span>
      </span>
      <GoalInput value={value} onChange={onChange} label={parameter.name} placeholder={parameter.doc} />
    </label>
  );
}

interface PlanAndStartProps {
  request: PlanWish;
  /** Whether there is a goal to plan for; the steps of other tasks are written down. */
  isPlanned: boolean;
  /** Takes a goal instead of one that has errors. */
  onFix: (goal: string) => void;
  onDone: () => void;
}

function PlanAndStart({ request, isPlanned, onFix, onDone }: PlanAndStartProps) {
  const { preview, problem, fixes } = usePreview(request, isPlanned);
  const options = useSignal<RunChoice>({});
  const key = useRef(crypto.randomUUID());
  const [busy, setBusy] = useState(false);
  const submit = async (): Promise<void> => {
    setBusy(true);
    const done = await start(
      { ...request, ...options.value, breakpoints: [...breakpoints.value] },
      key.current,
    );
    setBusy(false);
    key.current = crypto.randomUUID();
    if (done) onDone();
  };
  return (
    <>
      {problem !== "" && (
        <div class="notice bad stack">
          <p>{problem}</p>
          {fixes.map((each) => (
            <div key={each.goal}>
              <button title={each.goal} onClick={() => onFix(each.goal)}>
                {each.message.replace(/^write /, "Write ").replaceAll("`", "")}
              </button>
            </div>
          ))}
        </div>
      )}
      {!isPlanned && <p class="muted small">Its steps are written down: there is nothing to plan.</p>}
      {isPlanned && preview === null && problem === "" && (
        <p class="row muted" role="status">
          <span class="spinner" /> Planning for the world as it is now
        </p>
      )}
      {preview !== null && <Preview preview={preview} />}
      <RunOptions value={options.value} onChange={(value) => (options.value = value)} />
      <div class="row run-foot">
        <button
          class="primary grow"
          disabled={!mayCommand() || busy || preview?.status === "unsolvable" || problem !== ""}
          title={refusalOf("operate") || "Start in the cell (Enter)"}
          onClick={() => void submit()}
        >
          Start
        </button>
        <Rehearse request={request} />
        {!mayCommand() && <p class="small is-waiting refusal">{refusalOf("operate")}</p>}
      </div>
    </>
  );
}
