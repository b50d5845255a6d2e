// What an operation has as data: when it was submitted, started and ended, what its calls returned, and what it measured.
import type { ComponentChildren } from "preact";
import type { OperationStatus } from "../api/types";
import { describeTimes } from "../state/run_times";
import { replay, status } from "../state/studio";
import { formatTime } from "../state/text";
import { Fact, Value } from "./links";

/** How many values are shown without a click. */
const FEW = 8;

export function OperationTimes() {
  const current = status.value;
  if (current === null || replay.value !== null) return null;
  return <p class="small muted">{describeTimes(current)}</p>;
}

export function OperationData() {
  const current = status.value;
  if (current === null || replay.value !== null) return null;
  const [outputs, measures] = [current.outputs, current.measures];
  return (
    <>
      <Part title="Returned" count={outputs.length}>
        <Outputs outputs={outputs} />
      </Part>
      <Part title="Measured" count={measures.length}>
        <Measures measures={measures} />
      </Part>
    </>
  );
}

/** A part that can be folded, with nothing to show if there is nothing in it. */
function Part({ title, count, children }: { title: string; count: number; children: ComponentChildren }) {
  if (count === 0) return null;
  return (
    <details open={count <= FEW} class="operation-data">
      <summary>
        <strong>{title}</strong> <span class="muted small">{count}</span>
      </summary>
      {children}
    </details>
  );
}

function Outputs({ outputs }: { outputs: OperationStatus["outputs"] }) {
  return (
    <ul class="small">
      {outputs.map((each, index) => (
        <li key={index}>
          <span class="mono">
            {each.skill}.{each.name} = <Value value={each.value} />
          </span>
        </li>
      ))}
    </ul>
  );
}

function Measures({ measures }: { measures: OperationStatus["measures"] }) {
  return (
    <ul class="small">
      {measures.map((each, index) => (
        <li key={index}>
          <Fact fact={each.fact} />{" "}
          <span class="muted">
            {each.known} by {each.by}, {formatTime(each.time_s)}
          </span>
        </li>
      ))}
    </ul>
  );
}
