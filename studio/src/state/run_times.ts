// When operations were submitted, as their ids say.
import type { OperationStatus } from "../api/types";

/** Return when an operation was submitted, as its id says: `20260131T120000Z`. */
export function startOf(operation: OperationStatus): string {
  return /\d{8}T\d{6}Z/.exec(operation.id)?.[0] ?? "";
}

export function newestFirst(one: OperationStatus, other: OperationStatus): number {
  return startOf(other).localeCompare(startOf(one));
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
