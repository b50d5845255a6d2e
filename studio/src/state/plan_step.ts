// The step of a plan whose postures the 3-D view draws: one of the preview, else the one that is selected and goes on.
import { computed, signal } from "@preact/signals";
import type { ChosenPosture, PlanPreview } from "../api/types";
import { ancestors, type OperationState } from "./operation";
import { operation, preview, selection } from "./studio";

/** The number of the step of the preview, from 1; null if none is chosen. */
export const shownStep = signal<number | null>(null);

/** The postures of the step that is chosen, in order. */
export const shownPostures = computed(() => {
  if (shownStep.value !== null) return posturesOf(preview.value?.space, shownStep.value);
  const { value } = selection;
  return value.kind === "node" ? posturesOfCall(operation.value, value.key) : NONE;
});

const NONE: readonly ChosenPosture[] = [];

/** Return the postures in which arms bring their tools to poses in a step of a plan; none if nobody has looked. */
export function posturesOf(
  space: PlanPreview["space"] | undefined,
  step: number | null,
): readonly ChosenPosture[] {
  const found = space?.postures?.filter((each) => each.step === step) ?? NONE;
  return found.length === 0 ? NONE : found;
}

/** Return the postures of the step of a plan that a call is, or is a part of, if the step goes on. */
export function posturesOfCall(state: OperationState, key: number): readonly ChosenPosture[] {
  const around = [key, ...[...ancestors(state.nodes, key)].map((each) => each.key)];
  for (const { plan, nodes } of state.attempts) {
    const index = nodes.findIndex((each) => each !== null && around.includes(each));
    const call = state.nodes.get(nodes[index] ?? 0);
    if (call?.status === "running") return posturesOf(plan?.space, index + 1);
  }
  return NONE;
}
