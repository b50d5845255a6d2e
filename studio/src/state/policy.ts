// The rows of a plan before it runs: its steps, and below what may come of the last one those of each branch.
import type { PlanPreview, PreviewedBranch, PreviewedStep } from "../api/types";

/** A step of a plan, or what may come of the step before it; what lies in a branch has a greater `depth`. */
export type PreviewRow =
  | { kind: "step"; depth: number; number: number; step: PreviewedStep }
  | { kind: "outcome"; depth: number; text: string }
  | { kind: "note"; depth: number; text: string };

/** Return the rows of a plan in their order; steps are numbered as if only their branch came. */
export function previewRows({ plan, branches }: Pick<PlanPreview, "plan" | "branches">): PreviewRow[] {
  return [...rowsBelow(plan, branches, 0, 1)];
}

function* rowsBelow(
  steps: readonly PreviewedStep[],
  branches: readonly PreviewedBranch[],
  depth: number,
  first: number,
): Generator<PreviewRow> {
  for (const [index, step] of steps.entries()) yield { kind: "step", depth, number: first + index, step };
  for (const each of branches) {
    yield { kind: "outcome", depth, text: `${each.outcome} (${formatShare(each.likely)})` };
    const plan = each.plan ?? null;
    if (plan === null) yield { kind: "note", depth: depth + 1, text: "planned when it comes" };
    else if (plan.length === 0) yield { kind: "note", depth: depth + 1, text: "nothing is left to do" };
    else yield* rowsBelow(plan, each.branches ?? [], depth + 1, first + steps.length);
  }
}

/** Return a share from 0 to 1 as per cent with up to three digits. */
function formatShare(share: number): string {
  return `${Number((100 * share).toPrecision(3))} %`;
}
