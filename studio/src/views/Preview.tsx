// A plan before it runs: its steps, what is proved of it, and what was left out; or why there is none.
import type { PlanPreview } from "../api/types";
import { posturesOf, shownStep } from "../state/plan_step";
import { previewRows, type PreviewRow } from "../state/policy";
import { describePlan, formatTime } from "../state/text";
import { PlaceLink } from "./links";
import { NothingToDo } from "./NothingToDo";

export function Preview({ preview }: { preview: PlanPreview }) {
  if (preview.status !== "solved") return <NoPlan preview={preview} />;
  return (
    <section class="plan" aria-label="Plan">
      <h3 class="row spread">
        <span>Plan</span>
        <span class="muted small">{summary(preview)}</span>
      </h3>
      {preview.plan.length === 0 && <NothingToDo />}
      <ol class="preview">
        {previewRows(preview).map((row, index) => (
          <Row key={index} preview={preview} row={row} />
        ))}
      </ol>
      {preview.assumptions.map((each) => (
        <p key={each} class="small muted">
          assumed: {each}
        </p>
      ))}
      <LeftOut preview={preview} />
      {preview.note && <p class="small muted">{preview.note}</p>}
      {preview.space?.failure && <p class="small muted">does not go in space: {preview.space.failure}</p>}
    </section>
  );
}

/** A step, or what may come of the step before it: what lies in a branch is indented. */
function Row({ preview, row }: { preview: PlanPreview; row: PreviewRow }) {
  const indent = { marginLeft: `${row.depth * INDENT_PX}px` };
  if (row.kind !== "step")
    return (
      <li class={row.kind === "outcome" ? "small" : "small muted"} style={indent}>
        {row.text}
      </li>
    );
  const { arguments: given, skill, source } = row.step;
  return (
    <li class="preview-step" style={indent}>
      <StepNumber preview={preview} step={row.number} depth={row.depth} />
      <span>{skill}</span>
      <Source text={source} />
      <span class="plan-arguments muted small truncate" title={argumentsOf(given)}>
        {argumentsOf(given)}
      </span>
    </li>
  );
}

const INDENT_PX = 16;

/** The number of a step; one whose postures are known shows them in the 3-D view, and hides them again. */
function StepNumber({ preview, step, depth }: { preview: PlanPreview; step: number; depth: number }) {
  if (depth > 0 || posturesOf(preview.space, step).length === 0)
    return <span class="muted small mono">{step}</span>;
  const isShown = shownStep.value === step;
  const name = `${isShown ? "Hide" : "Show"} the postures of step ${step}`;
  return (
    <button
      type="button"
      class="link small mono"
      aria-pressed={isShown}
      aria-label={name}
      title={`${name} in the 3-D view`}
      onClick={() => (shownStep.value = isShown ? null : step)}
    >
      {step}
    </button>
  );
}

function Source({ text }: { text: string }) {
  const [, path, line] = /^(.*):(\d+)$/.exec(text) ?? [];
  if (path === undefined || line === undefined) return null;
  return (
    <span class="small">
      <PlaceLink place={{ path, line: Number(line), column: 1 }} />
    </span>
  );
}

const argumentsOf = (given: Record<string, string>): string => Object.values(given).join(", ");

function summary(preview: PlanPreview): string {
  const time = preview.makespan_s ?? preview.duration_s;
  const least = preview.at_least_s;
  const costs = preview.minimise === "cost";
  const bound = least === null ? "" : costs ? `cost ${least} or more` : `at least ${formatTime(least)}`;
  return [time === null ? "" : `about ${formatTime(time)}`, describePlan(preview), bound]
    .filter((each) => each !== "")
    .join(", ");
}

/** Return how many of each kind were left out, for whatever reason. */
function countLeftOut(all: PlanPreview["left_out"]): string {
  const counts = new Map<string, number>();
  for (const { kind, what } of all) counts.set(kind, (counts.get(kind) ?? 0) + what.length);
  return [...counts]
    .map(([kind, count]) => `${count} ${kind === "individuals" ? "things" : kind}`)
    .join(", ");
}

function LeftOut({ preview }: { preview: PlanPreview }) {
  if (preview.left_out.length === 0) return null;
  return (
    <details class="small">
      <summary>left out of the search: {countLeftOut(preview.left_out)}</summary>
      {preview.left_out.map((each, index) => (
        <div key={index} class="stack left-out">
          <p>
            {each.harmless ? "Makes no difference: " : "May make a difference: "}
            {each.why}
          </p>
          <p class="mono muted wrap-anywhere">{each.what.join(", ")}</p>
        </div>
      ))}
    </details>
  );
}

function NoPlan({ preview }: { preview: PlanPreview }) {
  return (
    <div class={`notice stack ${preview.status === "unsolvable" ? "bad" : "waiting"}`}>
      <p>
        <strong>{preview.status === "unsolvable" ? "No plan is possible." : "No plan was found."}</strong>{" "}
        {preview.failure}
      </p>
      <ul class="causes small">
        {preview.causes.map((each) => (
          <li key={each}>{each}</li>
        ))}
      </ul>
    </div>
  );
}
