// Resets a simulated cell to its scene, saves it under a name, and restores it.
import { signal } from "@preact/signals";
import { api } from "../api/client";
import type { Checkpoint } from "../api/types";
import { attempt } from "./actions";
import { cell, cellName, ongoing, refusalOf } from "./studio";
import { describeRequest } from "./text";

/** How the cell that is shown was saved, by name; null while that is not known. */
export const checkpoints = signal<readonly Checkpoint[] | null>(null);

/** Return why the cell that is shown cannot be reset, saved or restored now, as a sentence; nothing if it can. */
export function describeObstacle(): string {
  const current = cell.value;
  if (current === null || current.state === "off") return "The cell is off.";
  const [first] = ongoing.value;
  if (first !== undefined)
    return `${describeRequest(first.request)} goes on or waits; stop it, or wait until it has ended.`;
  return refusalOf("operate");
}

/** Read how the cell that is shown was saved. */
export function readCheckpoints(): Promise<boolean> {
  checkpoints.value = null;
  return attempt(async () => {
    const name = cellName.peek();
    if (name === null) return;
    const found = await api.checkpoints(name);
    if (cellName.peek() === name) checkpoints.value = found;
  });
}

/** Do something with the cell that is shown, and say that it was done. */
async function change(
  what: (cell: string) => Promise<unknown>,
  done: (cell: string) => string,
): Promise<boolean> {
  const name = cellName.peek();
  return name !== null && (await attempt(() => what(name), done(name)));
}

export function reset(): Promise<boolean> {
  return change(
    (name) => api.reset(name, "in the studio"),
    (name) => `${name} is again as its scene says.`,
  );
}

export async function save(checkpoint: string): Promise<boolean> {
  const isDone = await change(
    (name) => api.save(name, checkpoint),
    (name) => `${name} is saved as ${checkpoint}.`,
  );
  if (isDone) await refresh();
  return isDone;
}

export function restore(checkpoint: string): Promise<boolean> {
  return change(
    (name) => api.restore(name, checkpoint),
    (name) => `${name} is again as it was saved as ${checkpoint}.`,
  );
}

export async function remove(checkpoint: string): Promise<boolean> {
  const isDone = await change(
    (name) => api.removeCheckpoint(name, checkpoint),
    () => `${checkpoint} is forgotten.`,
  );
  if (isDone) await refresh();
  return isDone;
}

/** Read the checkpoints again; what was just said stays. */
async function refresh(): Promise<void> {
  const name = cellName.peek();
  if (name !== null) checkpoints.value = await api.checkpoints(name);
}
