// What a person does with the page. What is refused is shown, and nothing is done twice.
import { batch } from "@preact/signals";
import { api, ApiError, type CommandBody } from "../api/client";
import type { OperationRequest, OperationStatus } from "../api/types";
import { takeOperation } from "./live";
import type { Selection } from "./selection";
import * as studio from "./studio";

/** Do something that the server may refuse; what it says is shown. Return whether it was done. */
export async function attempt(what: () => Promise<unknown>, done = ""): Promise<boolean> {
  try {
    await what();
    studio.message.value = done === "" ? null : { kind: "done", text: done };
    return true;
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    studio.message.value = { kind: "error", text: error.message };
    return false;
  }
}

export function select(selection: Selection): void {
  studio.selection.value = selection;
}

/** Show an operation, from the beginning of its events; what is selected in it stays if it is shown already. */
export function showOperation(operation: OperationStatus): void {
  const isShown = studio.replay.peek() === null && studio.operationId.peek() === operation.id;
  batch(() => {
    takeOperation(operation);
    if (isShown) return;
    studio.cellName.value = operation.cell;
    studio.replay.value = null;
    studio.operationId.value = operation.id;
    studio.selection.value = { kind: "nothing" };
  });
}

export function showCell(name: string): void {
  batch(() => {
    studio.cellName.value = name;
    studio.replay.value = null;
    studio.library.value = null;
    studio.facts.value = [];
    studio.areFactsRead.value = false;
    studio.worldSequence.value = 0;
    const ofCell = [...studio.operations.value.values()].filter((each) => each.cell === name);
    const ongoing = ofCell.find((each) => !studio.ENDS.includes(each.state));
    studio.operationId.value = (ongoing ?? ofCell[0])?.id ?? null;
    studio.selection.value = { kind: "nothing" };
  });
}

/** Submit an operation in the cell that is shown, and show it. `key` makes a second click the same operation. */
export async function start(request: OperationRequest, key: string): Promise<boolean> {
  const cell = studio.cellName.value;
  if (cell === null) return false;
  return attempt(async () => showOperation(await api.submit(cell, request, key)));
}

/** Give a command to the operation that is shown. */
export function command(body: CommandBody): Promise<boolean> {
  return attempt(async () => {
    const id = studio.operationId.value;
    if (id !== null) takeOperation(await api.command(id, body));
  });
}

/** Stop the operation that is shown; it needs no role and no lease. */
export function stop(): Promise<boolean> {
  return attempt(async () => {
    const id = studio.operationId.value;
    if (id !== null) await api.stop(id, "stopped in the studio");
  });
}

export function logOut(): Promise<boolean> {
  return attempt(async () => {
    await api.logOut();
    studio.session.value = null;
  });
}
