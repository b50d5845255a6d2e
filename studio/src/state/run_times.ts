// When operations were submitted, as their ids say.
import type { OperationStatus } from "../api/types";
import { ENDS } from "./studio";
import { formatTime } from "./text";

/** Return when an operation was submitted, as its id says: `20260131T120000Z`. */
export function startOf(operation: OperationStatus): string {
  return /\d{8}T\d{6}Z/.exec(operation.id)?.[0] ?? "";
}

/** The times of an operation, as a server gives them; null or nothing if they are not known. */
interface Times {
  submitted_at?: string | null;
  started_at?: string | null;
  ended_at?: string | null;
}

/** Order operations: what goes on or waits first, then the last one that was submitted. */
export function newestFirst(one: OperationStatus, other: OperationStatus): number {
  const [ended, otherEnded] = [one, other].map((each) => ENDS.includes(each.state));
  if (ended !== otherEnded) return ended === true ? 1 : -1;
  return submittedOf(other).localeCompare(submittedOf(one));
}

const submittedOf = (operation: OperationStatus & Times): string =>
  `${startOf(operation)} ${operation.submitted_at ?? ""}`;

/** Return how long an operation took, or nothing if it goes on or that is not known. */
export function formatDuration({ started_at: from, ended_at: to }: OperationStatus & Times): string {
  if (typeof from !== "string" || typeof to !== "string") return "";
  return formatTime((Date.parse(to) - Date.parse(from)) / 1000);
}

/** Return when an operation was submitted, as people write it. */
export function formatStart(operation: OperationStatus): string {
  const [, year, month, day, hour, minute, second] =
    /(\d{4})(\d\d)(\d\d)T(\d\d)(\d\d)(\d\d)Z/.exec(operation.id) ?? [];
  if (year === undefined) return "";
  return new Date(`${year}-${month}-${day}T${hour}:${minute}:${second}Z`).toLocaleString(undefined, {
    dateStyle: "short",
    timeStyle: "medium",
  });
}
