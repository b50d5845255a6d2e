// Runs: what has run in the cell, with search; one is shown, replayed, or compared with another.
import { signal } from "@preact/signals";
import { api } from "../api/client";
import type { OperationStatus } from "../api/types";
import { attempt, showOperation } from "../state/actions";
import { openRecording, replayOperation } from "../state/replay";
import { cellName, operationId, operations, replay } from "../state/studio";
import { describeFailure, describeRequest } from "../state/text";
import { compare, Comparison } from "./Comparison";
import { RunBadge } from "./status";
import { choosing, runTab } from "./layout";

const search = signal("");

export function RunsView() {
  const text = search.value.toLowerCase();
  const all = [...operations.value.values()].filter((each) => each.cell === cellName.value).sort(newestFirst);
  const shown = all.filter((each) =>
    `${each.id} ${describeRequest(each.request)} ${each.state}`.toLowerCase().includes(text),
  );
  return (
    <div class="runs" onDragOver={(event) => event.preventDefault()} onDrop={(event) => void dropped(event)}>
      <div class="view-tools row">
        <input
          type="search"
          placeholder={`Search in ${all.length} runs`}
          aria-label="Search in the runs"
          value={search.value}
          onInput={(event) => (search.value = event.currentTarget.value)}
        />
        <label class="button-like">
          Open file
          <input
            type="file"
            accept=".mcap"
            class="visually-hidden"
            onChange={(event) => void chosen(event.currentTarget)}
          />
        </label>
      </div>
      <div class="scroll">
        {shown.length === 0 ? (
          <div class="empty">
            {all.length === 0
              ? "Nothing has run in this cell yet. Drop a recording (.mcap) here to play it."
              : "No run has this text."}
          </div>
        ) : (
          <ul>
            {shown.map((each) => (
              <Run key={each.id} run={each} />
            ))}
          </ul>
        )}
      </div>
    </div>
  );
}

function newestFirst(one: OperationStatus, other: OperationStatus): number {
  return startOf(other).localeCompare(startOf(one));
}

/** Return when an operation was submitted, as its id says: `20260131T120000Z`. */
function startOf(operation: OperationStatus): string {
  return /\d{8}T\d{6}Z/.exec(operation.id)?.[0] ?? "";
}

function formatStart(operation: OperationStatus): string {
  const [, year, month, day, hour, minute, second] =
    /(\d{4})(\d\d)(\d\d)T(\d\d)(\d\d)(\d\d)Z/.exec(operation.id) ?? [];
  if (year === undefined) return "";
  return new Date(`${year}-${month}-${day}T${hour}:${minute}:${second}Z`).toLocaleString(undefined, {
    dateStyle: "short",
    timeStyle: "medium",
  });
}

function Run({ run }: { run: OperationStatus }) {
  const isShown = run.id === operationId.value && replay.value === null;
  const show = (): void => {
    choosing.value = false;
    showOperation(run);
  };
  return (
    <li class={`run-item ${isShown ? "is-selected" : ""}`}>
      <button class="run-show" aria-pressed={isShown} title={run.id} onClick={show}>
        <span class="row spread">
          <strong class="truncate">{describeRequest(run.request)}</strong>
          <RunBadge state={run.state} verified={run.verified} />
        </span>
        <span class="muted small">
          {formatStart(run)}
          {run.request.owner ? ` · ${run.request.owner}` : ""} · {run.events} events
        </span>
        {run.failure != null && <span class="small run-failure">{describeFailure(run.failure)}</span>}
      </button>
      <div class="row run-actions">
        <button class="plain small" onClick={() => void attempt(() => replayOperation(run.id))}>
          Replay
        </button>
        {!isShown && (
          <button class="plain small" onClick={() => void compare(run.id)}>
            Compare
          </button>
        )}
        <button class="plain small" onClick={() => void attempt(() => download(run.id))}>
          Download
        </button>
      </div>
      <Comparison run={run.id} />
    </li>
  );
}

async function download(id: string): Promise<void> {
  const content = await api.recording(id);
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content]));
  link.download = `${id}.mcap`;
  link.click();
  URL.revokeObjectURL(link.href);
}

async function dropped(event: DragEvent): Promise<void> {
  event.preventDefault();
  const file = event.dataTransfer?.files[0];
  if (file !== undefined) await open(file);
}

async function chosen(input: HTMLInputElement): Promise<void> {
  const file = input.files?.[0];
  if (file !== undefined) await open(file);
  input.value = "";
}

async function open(file: File): Promise<void> {
  await attempt(async () => openRecording(file.name, await file.arrayBuffer()));
  runTab.value = "run";
}
