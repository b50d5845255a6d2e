// Edits of the world: which fact is edited, what is proposed, and the edit itself, which can be undone.
import { signal } from "@preact/signals";
import { api } from "../api/client";
import type { LabelledFact, WorldWrite } from "../api/types";
import { attempt } from "./actions";
import { readWorld } from "./live";
import { cellName, message, type Message, session } from "./studio";
import { editsOf } from "./world_changes";

/** What a person is about to change: a fact that is shown, a new one about a thing, or edits as lines. */
export type Editing =
  | { kind: "nothing" }
  | { kind: "fact"; fact: LabelledFact }
  | { kind: "new"; subject: string }
  | { kind: "lines"; edits: readonly string[]; why: string };

export const editing = signal<Editing>({ kind: "nothing" });

/** How far back one's own edit is looked for. */
const RECENT = 20;

/** Change the world of the cell that is shown, and offer to undo it; return whether it was done. */
export async function changeWorld(edits: readonly string[], why: string): Promise<boolean> {
  const name = cellName.value;
  if (name === null || !(await attempt(() => api.edit(name, [...edits], why)))) return false;
  editing.value = { kind: "nothing" };
  const said: Message = { kind: "done", text: `Changed: ${edits.join("; ")}` };
  message.value = said;
  await Promise.all([readWorld(true), offerUndo(name, why, said)]);
  return true;
}

async function offerUndo(cell: string, why: string, said: Message): Promise<void> {
  const who = session.peek()?.name ?? "";
  const writes: WorldWrite[] = await api.writes(cell, { limit: RECENT }).catch(() => []);
  const own = writes.find((each) => each.origin === `${who}: ${why}`);
  const back = own === undefined ? null : editsOf(own.undo ?? [], own.changes);
  if (own === undefined || back === null || message.peek() !== said) return;
  const undo = (): void => void changeWorld(back, `undoes write ${own.sequence} (${own.origin})`);
  message.value = { ...said, undo };
}
