// The history of a cell: what the page knows of it, and what the server finds in the rest.
import { batch } from "@preact/signals";
import { api, ApiError } from "../api/client";
import type { OperationStatus } from "../api/types";
import { takeOperation } from "./live";
import { cellName, operations } from "./studio";
import { describeRequest } from "./text";

const PAGE = 50;

/** Whether all words occur in an operation: in its id, in what was requested and by whom, or in how it is. */
export function hasWords(operation: OperationStatus, text: string): boolean {
  const { id, request, state, failure } = operation;
  const values = Object.values(request.arguments ?? {}).join(" ");
  const searched =
    `${id} ${describeRequest(request)} ${values} ${request.owner ?? ""} ${request.continues ?? ""} ${state} ${failure?.message ?? ""}`.toLowerCase();
  return text
    .toLowerCase()
    .split(/\s+/)
    .every((each) => searched.includes(each));
}

/** Look for words in the whole history of a cell; return whether there may be more. A search without answer finds none. */
export async function searchHistory(cell: string, text: string): Promise<boolean> {
  return take(cell, { search: text.trim(), limit: PAGE });
}

/** Read what was submitted before an operation that is known; return whether there may be more. */
export async function readOlder(cell: string, than: OperationStatus, text: string): Promise<boolean> {
  return take(cell, { search: text.trim(), limit: PAGE, before_ns: endOfSecond(than.id) });
}

async function take(cell: string, query: Record<string, string | number>): Promise<boolean> {
  try {
    const found = await api.operations(cell, query);
    if (cellName.peek() !== cell) return false;
    const known = operations.peek().size;
    batch(() => found.forEach(takeOperation));
    return found.length === PAGE && operations.peek().size > known;
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    return false;
  }
}

/** Return the end of the second in which an operation was submitted, in ns since 1970: its id has no more digits. */
export function endOfSecond(id: string): string {
  const [, year, month, day, hour, minute, second] =
    /(\d{4})(\d\d)(\d\d)T(\d\d)(\d\d)(\d\d)Z/.exec(id)?.map(Number) ?? [];
  if (year === undefined || month === undefined || second === undefined) return "";
  return `${BigInt(Date.UTC(year, month - 1, day, hour, minute, second + 1)) * 1_000_000n}`;
}
