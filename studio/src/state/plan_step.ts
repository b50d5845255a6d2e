// The step of the plan on the page whose postures the 3-D view draws.
import { computed, signal } from "@preact/signals";
import type { ChosenPosture, PlanPreview } from "../api/types";
import { preview } from "./studio";

/** The number of the step, from 1; null if none is chosen. */
export const shownStep = signal<number | null>(null);

/** The postures of the step that is chosen, in order. */
export const shownPostures = computed(() => posturesOf(preview.value, shownStep.value));

const NONE: readonly ChosenPosture[] = [];

/** Return the postures in which arms bring their tools to poses in a step of a plan; none if nobody has looked. */
export function posturesOf(plan: PlanPreview | null, step: number | null): readonly ChosenPosture[] {
  const found = plan?.space?.postures?.filter((each) => each.step === step) ?? NONE;
  return found.length === 0 ? NONE : found;
}
