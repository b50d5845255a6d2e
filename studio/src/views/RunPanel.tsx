// Run: choose what to do, see the plan first, start; then how far it is, and how it ended.
import type { Failure, RunState } from "../api/types";
import { command, select } from "../state/actions";
import {
  allows,
  cell,
  isOngoing,
  mayCommand,
  operation,
  refusalOf,
  replay,
  shownRun,
  shownTime,
} from "../state/studio";
import { describeRemaining, nameOperations } from "../state/activity";
import { bounds } from "../state/bounds";
import { NOTHING } from "../state/selection";
import { describePlan, formatTime, formatValue } from "../state/text";
import { BoundsChart } from "./BoundsChart";
import { Choose } from "./Choose";
import { Continue, Decisions } from "./Decisions";
import { Icon } from "./icons";
import { choosing, detailsTab, maximised } from "./layout";
import { NothingToDo } from "./NothingToDo";
import { OperationData, OperationTimes } from "./OperationData";
import { Planning } from "./Planning";
import { FalseClaims, NodeMark, RunBadge, toneOfEnd } from "./status";

export function RunPanel() {
  if (cell.value === null)
    return (
      <div class="empty">
        <span class="spinner" />
        Waiting for a cell
      </div>
    );
  if (shownRun.value === null || choosing.value) return <Choose onDone={() => (choosing.value = false)} />;
  return <Progress />;
}

function Progress() {
  const current = shownRun.value;
  if (current === null) return null;
  return (
    <div class="run stack">
      <div class="stack">
        <div class="row spread">
          <h3 class="truncate" title={current.title}>
            {current.title}
          </h3>
          {current.state !== null && <RunBadge {...current} state={current.state} />}
        </div>
        <OperationTimes />
        {current.reason !== "" && current.failure === null && (
          <p class="small wrap-anywhere">{nameOperations(current.reason)}</p>
        )}
        <FalseClaims claims={current.claims} />
        {current.failure !== null && <End failure={current.failure} state={current.state} />}
      </div>
      <Prompts />
      <Decisions />
      <Continue />
      <Plan />
      {current.state === "planning" && replay.value === null && <Planning />}
      <OperationData />
      <div class="row run-foot">
        <button class={isOngoing.value ? "grow" : "primary grow"} onClick={() => (choosing.value = true)}>
          {isOngoing.value ? "Submit another one" : "Run something else"}
        </button>
      </div>
    </div>
  );
}

/** Why it has ended, in short; all that was tried is one click away. */
function End({ failure, state }: { failure: Failure; state: RunState | null }) {
  const showAll = (): void => {
    select(NOTHING);
    detailsTab.value = "why";
    if (maximised.value !== null) maximised.value = "details";
  };
  return (
    <div class={`notice stack ${toneOfEnd(state)}`}>
      <p>{failure.message}</p>
      {(failure.causes ?? []).length > 0 && (
        <button class="link small" onClick={showAll}>
          All that was tried
        </button>
      )}
    </div>
  );
}

/** What skills ask, as buttons. */
function Prompts() {
  const open = shownRun.value?.goesOn ? operation.value.prompts : [];
  return (
    <>
      {open.map((each) => (
        <div key={each.id} class="notice waiting stack" role="alert">
          <p>{each.text}</p>
          <p class="small muted">{describeRemaining(each)}</p>
          <div class="row choices">
            {each.choices.map((choice) => (
              <button
                key={choice}
                disabled={!allows("answer") || !mayCommand()}
                title={refusalOf("operate")}
                onClick={() => void command({ type: "answer", choice, prompt: each.id ?? 0 })}
              >
                {choice}
              </button>
            ))}
          </div>
        </div>
      ))}
    </>
  );
}

/** The plans of the operation: each step with its state, its values and its span in time. */
function Plan() {
  const { attempts, nodes, task } = operation.value;
  const time = shownTime.value;
  if (attempts.length === 0) return null;
  const begin = task?.time ?? 0;
  const whole = { from: begin, to: Math.max(time, begin + 0.1) };
  return (
    <div class="stack">
      {attempts.map((attempt, index) => (
        <section key={index} class="plan" hidden={attempt.plan === null}>
          <h3 class="row spread">
            <span>{attempts.length > 1 ? `Plan ${index + 1}` : "Plan"}</span>
            {attempt.plan !== null && (
              <span class="muted small" title={attempt.plan.planner}>
                about {formatTime(attempt.plan.cost)}
                {describePlan(attempt.plan) && `, ${describePlan(attempt.plan)}`}
              </span>
            )}
          </h3>
          <ol>
            {(attempt.plan?.steps ?? []).map((step, at) => {
              const key = attempt.nodes[at] ?? null;
              const node = key === null ? undefined : nodes.get(key);
              return (
                <li key={at}>
                  <button
                    class="plan-step"
                    disabled={key === null}
                    onClick={() => key !== null && select({ kind: "node", key })}
                  >
                    <NodeMark status={node?.status ?? "pending"} />
                    <span>{step.skill}</span>
                    <span class="mono small muted">
                      {node === undefined ? "" : formatTime((node.endedAt ?? time) - node.startedAt)}
                    </span>
                    <Arguments values={Object.values(step.arguments).map(formatValue).join(", ")} />
                    <Span
                      from={node?.startedAt}
                      to={node?.endedAt ?? time}
                      whole={whole}
                      status={node?.status}
                    />
                  </button>
                </li>
              );
            })}
          </ol>
          {index === attempts.length - 1 && replay.value === null && !isOngoing.value && (
            <BoundsChart {...bounds.value} />
          )}
          {attempt.plan?.steps.length === 0 && <NothingToDo />}
          {attempt.reason !== "" && (
            <p class="notice waiting small">
              <Icon name="warning" /> Planned again: {attempt.reason}
            </p>
          )}
        </section>
      ))}
    </div>
  );
}

interface SpanProps {
  from: number | undefined;
  to: number;
  whole: { from: number; to: number };
  status: string | undefined;
}

/** When a step ran, as a bar in the time of the whole operation. */
function Span({ from, to, whole, status }: SpanProps) {
  if (from === undefined) return <span class="span" />;
  const percent = (time: number): number => (time / (whole.to - whole.from)) * 100;
  const [left, width] = [percent(from - whole.from), Math.max(0.8, percent(to - from))];
  return (
    <span class="span" aria-hidden="true">
      <span class={`span-bar is-${status ?? "pending"}`} style={{ left: `${left}%`, width: `${width}%` }} />
    </span>
  );
}

/** The arguments of a step; all of them where they do not fit. */
function Arguments({ values }: { values: string }) {
  return (
    <span class="plan-arguments muted small truncate" title={values}>
      {values}
    </span>
  );
}
