// Who changed what, and when; what differs between two of these times; and edits that undo a change, with who and why.
import type { ComponentChildren } from "preact";
import { useEffect, useState } from "preact/hooks";
import { api } from "../api/client";
import type { WorldWrite } from "../api/types";
import { read, select } from "../state/actions";
import { cellName, mayCommand, refusalOf, worldSequence } from "../state/studio";
import { formatMoment } from "../state/run_times";
import { formatChange } from "../state/text";
import { differencesOf, editsOf } from "../state/world_changes";

const MOST = 500;

function useWrites(): WorldWrite[] | null {
  const [writes, setWrites] = useState<WorldWrite[] | null>(null);
  const name = cellName.value;
  const sequence = worldSequence.value;
  useEffect(() => {
    if (name !== null) void read(async () => setWrites(await api.writes(name, { limit: MOST })));
  }, [name, sequence]);
  return writes;
}

function Waiting({ writes, children }: { writes: WorldWrite[] | null; children: ComponentChildren }) {
  if (writes === null)
    return (
      <div class="empty">
        <span class="spinner" />
        Reading who changed what
      </div>
    );
  if (writes.length === 0) return <div class="empty">Nobody has changed anything yet.</div>;
  return <>{children}</>;
}

const timeOf = (write: WorldWrite): string =>
  write.written_ns === 0 ? `write ${write.sequence}` : formatMoment(new Date(write.written_ns / 1e6));

interface WorldHistoryProps {
  /** Words; only what has all of them is shown. */
  search: string;
  onUndo: (edits: string[], why: string) => void;
}

const originOf = (write: WorldWrite): string => `${write.origin || "the scene"} ${write.evidence ?? "given"}`;

/** The writes, the last one first; `onUndo` gets the edits that undo one, and why. */
export function WorldHistory({ search, onUndo }: WorldHistoryProps) {
  const writes = useWrites();
  const words = search.toLowerCase().split(/\s+/);
  const shown = (writes ?? []).filter((each) => {
    const told = `${originOf(each)} ${each.changes.map(formatChange).join("; ")}`.toLowerCase();
    return words.every((word) => told.includes(word));
  });
  if (writes !== null && writes.length > 0 && shown.length === 0)
    return <div class="empty">Nobody has changed anything with “{search}” in it.</div>;
  return (
    <Waiting writes={writes}>
      <table>
        <thead>
          <tr>
            <th>when</th>
            <th>who, and why</th>
            <th>changes</th>
            <th>
              <span class="visually-hidden">undo</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {shown.map((each) => (
            <tr key={each.sequence}>
              <td class="muted when">{timeOf(each)}</td>
              <td class="wrap-anywhere">
                {each.origin || "the scene"} <span class="muted when">· {each.evidence ?? "given"}</span>
              </td>
              <td class="mono wrap-anywhere">{each.changes.map(formatChange).join("; ")}</td>
              <td>
                <UndoButton write={each} onUndo={onUndo} />
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </Waiting>
  );
}

interface UndoButtonProps {
  write: WorldWrite;
  onUndo: (edits: string[], why: string) => void;
}

/** Offers to undo what a person has stated: the edits can be seen, and changed, before they are made. */
function UndoButton({ write, onUndo }: UndoButtonProps) {
  if (write.evidence !== null || !write.origin.includes(": ")) return null;
  const edits = editsOf(write.undo ?? [], write.changes);
  const why =
    refusalOf("edit") ||
    (edits === null ? "No edit can state what was before" : "Show the edits that undo this, to make them");
  return (
    <button
      class="small"
      disabled={edits === null || !mayCommand("edit")}
      title={why}
      onClick={() => edits !== null && onUndo(edits, `undoes “${write.origin}”`)}
    >
      Undo
    </button>
  );
}

/** What differs between two times; both are after a write. */
export function WorldDifferences() {
  const writes = useWrites();
  const [from, setFrom] = useState<number | null>(null);
  const [to, setTo] = useState<number | null>(null);
  const ordered = [...(writes ?? [])].reverse();
  const first = from ?? (ordered[0]?.sequence ?? 1) - 1;
  const last = to ?? ordered.at(-1)?.sequence ?? 0;
  const found = differencesOf(ordered.filter((each) => each.sequence > first && each.sequence <= last));
  const option = (each: WorldWrite) => (
    <option key={each.sequence} value={each.sequence}>
      {`after ${timeOf(each)}, ${each.origin || "the scene"}`}
    </option>
  );
  return (
    <Waiting writes={writes}>
      <div class="row world-times">
        <select
          aria-label="From"
          value={first}
          onChange={(event) => setFrom(Number(event.currentTarget.value))}
        >
          <option value={(ordered[0]?.sequence ?? 1) - 1}>at the beginning</option>
          {ordered.map(option)}
        </select>
        <select aria-label="To" value={last} onChange={(event) => setTo(Number(event.currentTarget.value))}>
          {ordered.map(option)}
        </select>
      </div>
      {found.length === 0 ? (
        <p class="muted world-times">
          {first >= last
            ? "The second time is not after the first one."
            : "The world is the same at both times."}
        </p>
      ) : (
        <table>
          <thead>
            <tr>
              <th>what</th>
              <th>before</th>
              <th>after</th>
              <th>by</th>
            </tr>
          </thead>
          <tbody>
            {found.map((each) => (
              <tr key={each.what}>
                <td class="wrap-anywhere">
                  <button class="link mono" onClick={() => select({ kind: "thing", iri: each.individual })}>
                    {each.what}
                  </button>
                </td>
                <td class="mono wrap-anywhere">{each.before || "–"}</td>
                <td class="mono wrap-anywhere">{each.after || "–"}</td>
                <td class="muted wrap-anywhere">{each.by}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </Waiting>
  );
}
