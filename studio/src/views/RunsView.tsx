// Runs: what has run in the cell, with search; one is shown, replayed, or compared with another.
import { signal } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";
import { api } from "../api/client";
import type { OperationStatus } from "../api/types";
import { attempt, showOperation } from "../state/actions";
import { compareRuns } from "../state/comparison";
import { hasWords, readOlder, searchHistory } from "../state/history";
import { replayOperation } from "../state/replay";
import { goesOn, jobsOf, REPORT, runJob } from "../state/jobs";
import { cellName, ENDS, operationId, operations, replay, status } from "../state/studio";
import { describeArguments, describeRequest } from "../state/text";
import { openFile } from "./Dropping";
import { choosing } from "./layout";
import { formatDuration, formatStart, newestFirst } from "../state/run_times";
import { RunBadge, toneOfEnd } from "./status";

const search = signal("");
const SEARCH_MS = 250;
/** How many runs the page has at first. */
const FIRST_PAGE = 50;

export function RunsView() {
  const text = search.value;
  const cell = cellName.value;
  const [hasMore, setHasMore] = useState(true);
  useEffect(() => {
    if (cell === null || text.trim() === "") return setHasMore(true);
    let isCurrent = true;
    const timer = window.setTimeout(() => {
      void searchHistory(cell, text).then((more) => isCurrent && setHasMore(more));
    }, SEARCH_MS);
    return () => {
      isCurrent = false;
      window.clearTimeout(timer);
    };
  }, [cell, text]);
  const all = [...operations.value.values()].filter((each) => each.cell === cell).sort(newestFirst);
  const shown = all.filter((each) => hasWords(each, text));
  const last = shown.at(-1);
  return (
    <div class="runs">
      <div class="view-tools row">
        <input
          type="search"
          placeholder="Search in the runs"
          aria-label="Search in the runs"
          value={text}
          onInput={(event) => (search.value = event.currentTarget.value)}
        />
        <label class="button-like" title="Play a recording (.mcap); it can also be dropped on the page">
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
        {last === undefined ? (
          <div class="empty">
            {all.length === 0
              ? "Nothing has run in this cell yet. Drop a recording (.mcap) on the page to play it."
              : "No run of this cell has these words."}
          </div>
        ) : (
          <ul>
            {shown.map((each) => (
              <Run key={each.id} run={each} />
            ))}
          </ul>
        )}
        {cell !== null && last !== undefined && hasMore && all.length >= FIRST_PAGE && (
          <button class="plain older" onClick={() => void readOlder(cell, last, text).then(setHasMore)}>
            Show older runs
          </button>
        )}
      </div>
    </div>
  );
}

function Run({ run }: { run: OperationStatus }) {
  const isShown = run.id === operationId.value && replay.value === null;
  const first = status.value;
  const given = describeArguments(run.request);
  const show = (): void => {
    choosing.value = false;
    showOperation(run);
  };
  return (
    <li class={`run-item ${isShown ? "is-selected" : ""}`}>
      <button class="run-show" aria-pressed={isShown} title={run.id} onClick={show}>
        <span class="row spread">
          <strong class="truncate" title={describeRequest(run.request)}>
            {describeRequest(run.request)}
          </strong>
          <RunBadge state={run.state} verified={run.verified} claims={run.false_claims} />
        </span>
        {given !== "" && <span class="mono wrap-anywhere">{given}</span>}
        <span class="muted small">
          {[formatStart(run), formatDuration(run), run.request.owner].filter(Boolean).join(" · ")}
        </span>
        {run.failure != null && (
          <span class={`small run-failure ${toneOfEnd(run.state) === "bad" ? "is-bad" : "muted"}`}>
            {run.failure.message}
          </span>
        )}
      </button>
      {run.state !== "queued" && (
        <div class="row run-actions">
          <button class="plain small" onClick={() => void attempt(() => replayOperation(run.id))}>
            Replay
          </button>
          {first !== null && first.id !== run.id && first.state !== "queued" && (
            <button
              class="plain small"
              title="Side by side: the run that is shown (A), and this one (B)"
              onClick={() => void compareRuns(first, run)}
            >
              Compare
            </button>
          )}
          <button class="plain small" onClick={() => void attempt(() => download(run.id))}>
            Download
          </button>
          {ENDS.includes(run.state) && <Report id={run.id} />}
        </div>
      )}
    </li>
  );
}

/** Has the report of a run made, and then leads to it. */
function Report({ id }: { id: string }) {
  const job = jobsOf("report").find((each) => each.request.operation === id);
  if (job?.state === "ended")
    return (
      <a class="small" href={api.jobPage(job.id, REPORT)} target="_blank" rel="noopener" ref={takeFocus}>
        Open report
      </a>
    );
  const isBusy = job !== undefined && goesOn(job);
  const make = (): Promise<boolean> => attempt(() => runJob({ kind: "report", operation: id, film: false }));
  return (
    <button
      class="plain small"
      aria-disabled={isBusy}
      title="What was done, why and how well, as a page: it is made from the recording"
      onClick={() => !isBusy && void make()}
    >
      {isBusy && <span class="spinner" />}
      {isBusy ? "It is made" : "Report"}
    </button>
  );
}

/** Give an element the keyboard if what had it before is gone. */
function takeFocus(element: HTMLElement | null): void {
  if (document.activeElement === document.body) element?.focus();
}

async function download(id: string): Promise<void> {
  const content = await api.recording(id);
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content]));
  link.download = `${id}.mcap`;
  link.click();
  URL.revokeObjectURL(link.href);
}

async function chosen(input: HTMLInputElement): Promise<void> {
  const file = input.files?.[0];
  if (file !== undefined) await openFile(file);
  input.value = "";
}
