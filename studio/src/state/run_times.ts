// When operations were submitted, began and ended.
import type { OperationStatus } from "../api/types";
import { ENDS } from "./studio";
import { formatTime } from "./text";

/** Return when an operation was submitted, as its id says: `20260131T120000Z`. */
function startOf(operation: OperationStatus): string {
  return /\d{8}T\d{6}Z/.exec(operation.id)?.[0] ?? "";
}

/** Order operations: what goes on or waits first, then the last one that was submitted. */
export function newestFirst(one: OperationStatus, other: OperationStatus): number {
  const [ended, otherEnded] = [one, other].map((each) => ENDS.includes(each.state));
  if (ended !== otherEnded) return ended === true ? 1 : -1;
  return submittedOf(other).localeCompare(submittedOf(one));
}

const submittedOf = (operation: OperationStatus): string =>
  `${startOf(operation)} ${operation.submitted_at ?? ""}`;

/** Return how long an operation took, or nothing if it goes on or that is not known. */
export function formatDuration({ started_at: from, ended_at: to }: OperationStatus): string {
  if (typeof from !== "string" || typeof to !== "string") return "";
  return formatTime((Date.parse(to) - Date.parse(from)) / 1000);
}

/** Return a time by the clock of this machine, with its day if that is not `today`. */
export function formatMoment(at: Date, today = new Date()): string {
  if (at.toDateString() === today.toDateString())
    return at.toLocaleTimeString(undefined, { timeStyle: "medium" });
  return at.toLocaleString(undefined, { dateStyle: "short", timeStyle: "medium" });
}

/** Return when something was submitted, as its id says and people write it. */
export function formatStart(operation: { id: string }): string {
  const [, year, month, day, hour, minute, second] =
    /(\d{4})(\d\d)(\d\d)T(\d\d)(\d\d)(\d\d)Z/.exec(operation.id) ?? [];
  if (year === undefined) return "";
  return new Date(`${year}-${month}-${day}T${hour}:${minute}:${second}Z`).toLocaleString(undefined, {
    dateStyle: "short",
    timeStyle: "medium",
  });
}

/** Return when an operation was submitted, began and ended by the clock of this machine, and how long it took. */
export function describeTimes(operation: OperationStatus): string {
  const { submitted_at: submitted, started_at: started, ended_at: ended } = operation;
  let day = new Date();
  const said = Object.entries({ submitted, started, ended }).flatMap(([name, at]) => {
    if (typeof at !== "string") return [];
    const before = day;
    day = new Date(at);
    return [`${name} ${formatMoment(day, before)}`];
  });
  const took = formatDuration(operation);
  return said.join(", ") + (took === "" ? "" : ` after ${took}`);
}
