// What a person does with the page. What is refused is shown, and nothing is done twice.
import { batch } from "@preact/signals";
import { api, ApiError, type CommandBody } from "../api/client";
import type { OperationRequest, OperationStatus } from "../api/types";
import { takeOperation } from "./live";
import type { Selection } from "./selection";
import * as studio from "./studio";
import { describeRequest } from "./text";

/** Read what the server may refuse; what it says then is shown, and what is shown stays otherwise. Return whether it was read. */
export async function read(what: () => Promise<unknown>): Promise<boolean> {
  try {
    await what();
    return true;
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    studio.message.value = { kind: "error", text: error.message };
    return false;
  }
}

/** Do something that the server may refuse; what it says is shown, and what was said meanwhile stays. Return whether it was done. */
export async function attempt(what: () => Promise<unknown>, done = ""): Promise<boolean> {
  const before = studio.message.peek();
  const isDone = await read(what);
  if (isDone && done !== "") studio.message.value = { kind: "done", text: done };
  else if (isDone && studio.message.peek() === before) studio.message.value = null;
  return isDone;
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

/** Give a command to an operation, by default the one that is shown. */
export function command(body: CommandBody, id = studio.operationId.peek()): Promise<boolean> {
  return attempt(async () => {
    if (id !== null) takeOperation(await api.command(id, body));
  });
}

/** After how long without an answer to Stop the page says so. */
const UNHEARD_MS = 3000;

/** Stop all that goes on in the cell that is shown, whoever started it and whatever is shown; no role or lease is needed. */
export async function stop(): Promise<void> {
  const name = studio.cellName.peek();
  if (name === null) return fail("Nothing was stopped: this page knows no cell yet.");
  const stopped = studio.ongoing.peek().map(describeOwned).join(", ");
  const unheard = (why: string): void =>
    fail(`Whether ${name} stops is not known: ${why}. Use the emergency stop of the machine.`);
  const timer = window.setTimeout(() => unheard("the server has not answered yet"), UNHEARD_MS);
  try {
    const { state } = await api.stop(name, "stopped in the studio");
    const how = state === "off" ? "is off" : "was stopped";
    // What the page does not know of yet is stopped as well, so that it never says that nothing was.
    studio.message.value = { kind: "done", text: `${name} ${how}${stopped && `: ${stopped}`}.` };
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    unheard(error.message);
  } finally {
    window.clearTimeout(timer);
  }
}

function fail(text: string): void {
  studio.message.value = { kind: "error", text };
}

const describeOwned = ({ request }: OperationStatus): string =>
  `${describeRequest(request)}${request.owner ? ` (${request.owner})` : ""}`;

export function logOut(): Promise<boolean> {
  return attempt(async () => {
    await api.logOut();
    studio.session.value = null;
  });
}
