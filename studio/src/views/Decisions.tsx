// What a person can decide about an operation: whether it goes on after a pause, a plan, a failure or an interruption.
import type { LabelledValue } from "../api/types";
import { command, start } from "../state/actions";
import { allows, mayCommand, operation, refusalOf, replay, status } from "../state/studio";
import { formatValue } from "../state/text";

const DECISIONS = [
  { name: "resume", label: "Go on", why: "Let it go on after the pause" },
  { name: "approve", label: "Approve the plan", why: "Run this plan" },
  { name: "retry", label: "Try again", why: "Run the failed step again" },
  { name: "skip", label: "Count as done", why: "Somebody did the step by hand; its effects are assumed" },
  { name: "replan", label: "Plan again", why: "Make another plan for the world as it is" },
] as const;

/** How an operation that was interrupted can be continued; nothing goes on by itself. */
export function Continue() {
  const current = status.value;
  if (replay.value !== null || current?.state !== "interrupted" || current.continued_by !== "") return null;
  const halted = describeHalted();
  const go = (decision: "replan" | "retry" | "skip"): void => {
    const why = decision === "skip" ? "counted as done in the studio" : "";
    void start({ continues: current.id, decision, why }, crypto.randomUUID());
  };
  return (
    <>
      <p class="small">
        {halted !== undefined && `It was interrupted in ${halted}. `}
        How shall it go on? Check first how the cell is now.
      </p>
      <div class="row decisions">
        {current.decisions.map((name) => {
          const known = DECISIONS.find((each) => each.name === name);
          return (
            <button
              key={name}
              disabled={!mayCommand()}
              title={refusalOf("operate") || known?.why}
              onClick={() => go(name)}
            >
              {known?.label ?? name}
            </button>
          );
        })}
      </div>
    </>
  );
}

/** Return the step in which the operation was interrupted; undefined if it was in none. */
function describeHalted(): string | undefined {
  const { attempts, nodes } = operation.value;
  const last = attempts.at(-1);
  const at = (last?.nodes ?? []).findIndex((key) => key !== null && nodes.get(key)?.status === "halted");
  return describeStep(last?.plan?.steps[at]);
}

/** What a person can decide now: about a plan, or after a failure. */
export function Decisions() {
  const possible = DECISIONS.filter((each) => allows(each.name));
  if (possible.length === 0) return null;
  const give = (type: (typeof DECISIONS)[number]["name"]): void =>
    void command(type === "skip" ? { type, why: "counted as done in the studio" } : { type });
  const next = describeNext();
  return (
    <>
      {allows("resume") && next !== undefined && <p class="notice waiting">Next: {next}</p>}
      <div class="row decisions">
        {possible.map((each, index) => (
          <button
            key={each.name}
            class={index === 0 && each.name !== "replan" ? "primary" : ""}
            disabled={!mayCommand()}
            title={refusalOf("operate") || each.why}
            onClick={() => give(each.name)}
          >
            {each.label}
          </button>
        ))}
      </div>
    </>
  );
}

/** Return the step of the plan that is next; undefined while one goes on, or without a plan. */
function describeNext(): string | undefined {
  const { attempts, nodes } = operation.value;
  const last = attempts.at(-1);
  const statuses = (last?.plan?.steps ?? []).map((_, at) => {
    const key = last?.nodes[at] ?? null;
    return key === null ? "pending" : (nodes.get(key)?.status ?? "pending");
  });
  const at = statuses.findIndex((each) => each !== "success");
  return statuses[at] === "running" ? undefined : describeStep(last?.plan?.steps[at]);
}

function describeStep(
  step: { skill: string; arguments: Record<string, LabelledValue> } | undefined,
): string | undefined {
  if (step === undefined) return undefined;
  return `${step.skill} ${Object.values(step.arguments).map(formatValue).join(", ")}`;
}
