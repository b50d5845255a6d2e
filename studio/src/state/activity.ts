// What goes on, waits, asks or was interrupted in the cell that is shown, whoever started it.
import { computed } from "@preact/signals";
import type { OperationStatus, Prompt } from "../api/types";
import { newestFirst } from "./run_times";
import { cellName, ENDS, ongoing, operations, sample } from "./studio";
import { describeRequest, formatTime } from "./text";

/** Why an operation is shown; those that come first want a person most. */
export type Attention = "asks" | "decides" | "interrupted" | "goes on" | "waits";

/** An operation with why it is shown, and what it asks if it does. */
export interface Activity {
  operation: OperationStatus;
  attention: Attention;
  prompt: Prompt | null;
}

const ORDER: readonly Attention[] = ["asks", "decides", "interrupted", "goes on", "waits"];

export const activities = computed(() =>
  findActivities([...operations.value.values()].filter((each) => each.cell === cellName.value)),
);

/** Those that wait for planners and devices, in their order. */
export const queue = computed(() =>
  ongoing.value.filter((each) => each.place > 0).sort((one, other) => one.place - other.place),
);

/** Return what is to be shown of operations: what wants a person first, what waits in its order. */
export function findActivities(all: readonly OperationStatus[]): Activity[] {
  const going = all.filter((each) => !ENDS.includes(each.state)).map(describeOngoing);
  const left = findInterrupted(all).map((operation) => ({
    operation,
    attention: "interrupted" as const,
    prompt: null,
  }));
  return [...going, ...left].sort(
    (one, other) =>
      ORDER.indexOf(one.attention) - ORDER.indexOf(other.attention) ||
      one.operation.place - other.operation.place,
  );
}

function describeOngoing(operation: OperationStatus): Activity {
  const [prompt = null] = [...operation.prompts].sort((one, other) => one.ends_s - other.ends_s);
  return { operation, attention: attentionOf(operation), prompt };
}

function attentionOf({ prompts, state, allowed, place }: OperationStatus): Attention {
  if (prompts.length > 0) return "asks";
  if (state === "planned" || state === "paused" || allowed.includes("retry")) return "decides";
  return place > 0 ? "waits" : "goes on";
}

/** Return what was interrupted and may be continued, unless something else has run in the cell since. */
function findInterrupted(all: readonly OperationStatus[]): OperationStatus[] {
  const ended = all.filter((each) => ENDS.includes(each.state)).sort(newestFirst);
  const later = ended.findIndex((each) => each.state !== "interrupted");
  return ended
    .slice(0, later < 0 ? ended.length : later)
    .filter((each) => each.continued_by === "" && each.decisions.length > 0);
}

/** Return for how many seconds of the cell a question may still be answered; null while the time is not known. */
function secondsLeft({ ends_s }: Prompt): number | null {
  const now = sample.value?.time_s;
  return now === undefined ? null : Math.max(0, Math.ceil(ends_s - now));
}

/** Return for how long a question may still be answered; nothing while the time is not known. */
export function describeLeft(prompt: Prompt): string {
  const left = secondsLeft(prompt);
  if (left === null) return "";
  return left === 0 ? "the time to answer is over" : `${left < 100 ? `${left} s` : formatTime(left)} left`;
}

/** Return the same with what happens then. */
export function describeRemaining(prompt: Prompt): string {
  const left = describeLeft(prompt);
  if (!secondsLeft(prompt)) return left;
  return `${left}, then ${prompt.default ? `“${prompt.default}” counts` : "the skill fails"}`;
}

/** Return who wants what. */
export function describeOwned({ request }: OperationStatus): string {
  return `${describeRequest(request)}${request.owner ? ` (${request.owner})` : ""}`;
}

/** Return a sentence about operations in which they are called as a person calls them, not by their ids. */
export function nameOperations(text: string): string {
  const named = [...operations.value.values()].filter(({ id }) => text.includes(id));
  return named.reduce((said, each) => said.replaceAll(each.id, describeOwned(each)), text);
}

/** Return the order of a queue in which one operation comes one place earlier, or later. */
export function movedBy(order: readonly string[], id: string, by: -1 | 1): string[] {
  const at = order.indexOf(id);
  const to = at + by;
  if (at < 0 || to < 0 || to >= order.length) return [...order];
  const rest = order.filter((each) => each !== id);
  return [...rest.slice(0, to), id, ...rest.slice(to)];
}
