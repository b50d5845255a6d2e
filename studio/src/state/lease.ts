// The lease of the cell that is shown: who has it, taking it, keeping it while the page is open, giving it back.
import { effect } from "@preact/signals";
import { api, ApiError } from "../api/client";
import type { Lease } from "../api/types";
import { attempt } from "./actions";
import { cellName, connection, lease, session } from "./studio";

const LOOK_MS = 2000;
/** For how long a page takes the lease, and how much of that is left when it prolongs it. */
const [DURATION_S, LEFT_S] = [60, 30];

/** The cells whose lease this page has taken: it survives that the page is loaded again, but not that it is closed. */
const KEPT = "studio.leases";
const taken = new Set<string>(JSON.parse(sessionStorage.getItem(KEPT) ?? "[]") as string[]);

function note(cell: string, isTaken: boolean): void {
  if (isTaken) taken.add(cell);
  else taken.delete(cell);
  sessionStorage.setItem(KEPT, JSON.stringify([...taken]));
}

/** Look again and again who has the lease; the function that is returned ends that. */
export function followLease(): () => void {
  return effect(() => {
    const cell = cellName.value;
    lease.value = null;
    if (cell === null || connection.value.state !== "open") return;
    void look(cell);
    const timer = window.setInterval(() => void look(cell), LOOK_MS);
    return () => window.clearInterval(timer);
  });
}

async function look(cell: string): Promise<void> {
  try {
    let found = await api.lease(cell);
    const isOwn = found.owner !== null && found.owner === session.peek()?.name;
    if (taken.has(cell) && !isOwn) note(cell, false);
    if (taken.has(cell) && found.remaining_s < LEFT_S) found = await api.takeLease(cell, DURATION_S);
    show(cell, found);
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
  }
}

function show(cell: string, found: Lease): void {
  if (cellName.peek() === cell) lease.value = found;
}

/** Take the lease, and prolong it while this page is open. */
export function takeLease(takeover = false): Promise<boolean> {
  return attempt(async () => {
    const cell = cellName.peek();
    if (cell === null) return;
    show(cell, await api.takeLease(cell, DURATION_S, takeover));
    note(cell, true);
  });
}

export function releaseLease(): Promise<boolean> {
  return attempt(async () => {
    const cell = cellName.peek();
    if (cell === null) return;
    note(cell, false);
    await api.releaseLease(cell);
    show(cell, { cell, owner: null, remaining_s: 0 });
  });
}
