// The reports of runs: the server makes one from a recording when it is wanted.
import { signal } from "@preact/signals";
import { api, ApiError } from "../api/client";
import { attempt } from "./actions";

const LOOK_MS = 500;

/** How far the report of each run is, by the id of the operation. */
export const reports = signal<ReadonlyMap<string, "made" | "making">>(new Map());

function note(id: string, how: "made" | "making" | null): void {
  const known = new Map(reports.peek());
  if (how === null) known.delete(id);
  else known.set(id, how);
  reports.value = known;
}

/** Make the report of a run, without a film, and wait for it; what is refused is shown. */
export async function makeReport(id: string): Promise<void> {
  note(id, "making");
  const isMade = await attempt(async () => {
    let found = await api.makeReport(id);
    while (found.state !== "ended") {
      await new Promise((resolve) => window.setTimeout(resolve, LOOK_MS));
      found = await api.report(id);
    }
    if (found.result === null) throw new ApiError(0, `The report was not made: ${found.reason}`);
  });
  note(id, isMade ? "made" : null);
}
