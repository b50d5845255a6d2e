// Two runs side by side: their plans and calls in one table, what differs as `skillc diff` says it, and their signals.
import { signal } from "@preact/signals";
import type { OperationStatus } from "../api/types";
import { attempt, select, showOperation } from "../state/actions";
import { isDifferentCall, type CallPair, type NumberedCall } from "../state/calls";
import { compareRuns, comparison, differencesOfCalls, type Comparison } from "../state/comparison";
import { replayOperation } from "../state/replay";
import { describeRequest, formatTime } from "../state/text";
import { ComparedSignals } from "./ComparedSignals";
import { Differences } from "./Differences";
import { FullPage } from "./FullPage";
import { NodeMark, RunBadge } from "./status";
import { formatStart } from "../state/run_times";

const onlyDifferent = signal(false);

export function ComparisonPage({ shown }: { shown: Comparison }) {
  const close = (): void => {
    comparison.value = null;
  };
  return (
    <FullPage title="Two runs side by side" onClose={close} tools={<Tools shown={shown} />}>
      {shown.found === null ? (
        <div class="empty" role="status">
          <span class="spinner" />
          Both recordings are read and compared
        </div>
      ) : (
        <div class="comparison">
          <section class="comparison-calls" aria-label="Plans and calls">
            <Calls shown={shown} found={shown.found} />
          </section>
          <div class="comparison-side">
            <Differences diff={shown.found.diff} />
            <ComparedSignals first={shown.found.first.plotted} second={shown.found.second.plotted} />
          </div>
        </div>
      )}
    </FullPage>
  );
}

function Tools({ shown }: { shown: Comparison }) {
  return (
    <>
      <label class="row small">
        <input
          type="checkbox"
          checked={onlyDifferent.value}
          onChange={() => (onlyDifferent.value = !onlyDifferent.value)}
        />
        only what differs
      </label>
      <button onClick={() => void compareRuns(shown.second, shown.first)}>Swap</button>
    </>
  );
}

interface CallsProps {
  shown: Comparison;
  found: NonNullable<Comparison["found"]>;
}

function Calls({ shown, found }: CallsProps) {
  const differences = differencesOfCalls(found.diff);
  const wanted = found.pairs.filter(
    (each) => !onlyDifferent.value || differences.has(each.number) || isDifferentCall(each),
  );
  const scale = Math.max(durationOf(found.first.state), durationOf(found.second.state), 0.1);
  const plans = Math.max(found.first.state.attempts.length, found.second.state.attempts.length);
  return (
    <table class="comparison-table">
      <thead>
        <tr>
          <th scope="col" class="comparison-mark">
            <span class="visually-hidden">whether it differs</span>
          </th>
          <th scope="col">call</th>
          <RunHead name="A" run={shown.first} />
          <RunHead name="B" run={shown.second} />
        </tr>
      </thead>
      <tbody>
        {Array.from({ length: plans }, (_, at) => (
          <tr key={`plan ${at}`} class="comparison-plan">
            <td />
            <th scope="row">{plans > 1 ? `plan ${at + 1}` : "plan"}</th>
            <PlanCell attempt={found.first.state.attempts[at]} />
            <PlanCell attempt={found.second.state.attempts[at]} />
          </tr>
        ))}
        {wanted.map((each) => (
          <CallLine
            key={each.number}
            pair={each}
            scale={scale}
            runs={[shown.first, shown.second]}
            what={(differences.get(each.number) ?? []).map((one) => one.what).join("\n")}
          />
        ))}
        {wanted.length === 0 && (
          <tr>
            <td colSpan={4} class="muted">
              All calls are the same, in what they chose, how they ended and how long they took.
            </td>
          </tr>
        )}
      </tbody>
    </table>
  );
}

const durationOf = (state: CallsProps["found"]["first"]["state"]): number =>
  state.time - (state.task?.time ?? 0);

function RunHead({ name, run }: { name: string; run: OperationStatus }) {
  const open = (): void => {
    comparison.value = null;
    showOperation(run);
  };
  const play = (): void => {
    comparison.value = null;
    void attempt(() => replayOperation(run.id));
  };
  return (
    <th scope="col">
      <div class="row">
        <span class={`side-name side-${name.toLowerCase()}`}>{name}</span>
        <strong class="truncate" title={run.id}>
          {describeRequest(run.request)}
        </strong>
        <RunBadge state={run.state} verified={run.verified} claims={run.false_claims} />
      </div>
      <div class="row comparison-when">
        <span class="grow truncate">{formatStart(run)}</span>
        <button class="link small" onClick={open}>
          Show
        </button>
        <button class="link small" onClick={play}>
          Replay
        </button>
      </div>
    </th>
  );
}

function PlanCell({
  attempt: of,
}: {
  attempt: CallsProps["found"]["first"]["state"]["attempts"][number] | undefined;
}) {
  if (of === undefined) return <td class="muted">none</td>;
  if (of.plan === null) return <td class="muted">not planned</td>;
  return (
    <td>
      {of.plan.steps.length} steps, about {formatTime(of.plan.cost)}
      <span class="muted">
        {[of.plan.quality || of.plan.optimal, of.plan.planner].map((each) => each && `, ${each}`)}
      </span>
      {of.reason !== "" && <div class="is-waiting">planned again: {of.reason}</div>}
    </td>
  );
}

interface CallLineProps {
  pair: CallPair;
  scale: number;
  runs: readonly [OperationStatus, OperationStatus];
  what: string;
}

function CallLine({ pair, scale, runs, what }: CallLineProps) {
  const differs = what !== "" || isDifferentCall(pair);
  const skill = pair.first?.skill ?? pair.second?.skill ?? "";
  return (
    <tr class={differs ? "is-different" : ""}>
      <td class="comparison-mark" title={what}>
        {differs && (
          <>
            <span aria-hidden="true">≠</span>
            <span class="visually-hidden">differs</span>
          </>
        )}
      </td>
      <th scope="row">
        <span style={{ paddingLeft: `${pair.depth * 14}px` }}>
          <span class="muted mono">{pair.number}</span> {skill}
        </span>
      </th>
      <CallCell call={pair.first} scale={scale} run={runs[0]} skill={skill} />
      <CallCell call={pair.second} scale={scale} run={runs[1]} skill={skill} />
    </tr>
  );
}

interface CallCellProps {
  call: NumberedCall | null;
  scale: number;
  run: OperationStatus;
  skill: string;
}

function CallCell({ call, scale, run, skill }: CallCellProps) {
  if (call === null) return <td class="muted">not in this run</td>;
  const { key, startedAt, took } = call;
  const show = (): void => {
    comparison.value = null;
    showOperation(run);
    if (key !== null) select({ kind: "node", key });
  };
  return (
    <td>
      <button
        class="comparison-call"
        disabled={key === null}
        title={key === null ? "It has not started" : "Show this call in its run"}
        onClick={show}
      >
        <NodeMark status={call.status} />
        <span class="grow truncate" title={call.values}>
          {call.skill === skill ? "" : `${call.skill} `}
          {call.implementation} <span class="muted small">{call.values}</span>
        </span>
        <span class="mono muted">{took === null ? "" : formatTime(took)}</span>
      </button>
      <span class="span" aria-hidden="true">
        {startedAt !== null && (
          <span
            class={`span-bar is-${call.status}`}
            style={{
              left: `${(startedAt / scale) * 100}%`,
              width: `${Math.max(0.8, ((took ?? scale - startedAt) / scale) * 100)}%`,
            }}
          />
        )}
      </span>
    </td>
  );
}
