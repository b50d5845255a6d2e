// The real arms of the cell that is shown: the reports of the processes that control them, as words and numbers.
import { computed } from "@preact/signals";
import type { ControlReport } from "../api/types";
import { sample } from "./studio";

export const realArms = computed((): readonly ControlReport[] =>
  Object.values(sample.value?.arms ?? {}).flatMap(({ control }) => control ?? []),
);

/** Whether the cell is one of real arms: nothing in it is simulated. */
export const isReal = computed(() => realArms.value.length > 0);

/** Return the rate of an arm, and by how much its latest period began late; nothing while there are no periods. */
export function describeRate({ rate_hz: rate, late_s: late }: ControlReport): string {
  if (rate === null || late === null) return "";
  return `${rate.toFixed(0)} Hz, late by ${formatMilliseconds(late)}`;
}

/** Return at which share of the commanded speeds an arm moves; nothing at full speed. */
export function describeSlider({ speed_share: share }: ControlReport): string {
  return share < 0.995 ? `speed ${(share * 100).toFixed(0)} %` : "";
}

export function formatMilliseconds(seconds: number): string {
  const milliseconds = seconds * 1000;
  return `${milliseconds.toFixed(milliseconds < 10 ? 1 : 0)} ms`;
}
