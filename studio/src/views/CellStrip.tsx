// The strip above all views: what goes on, waits, asks or was interrupted in the cell, whoever started it.
import { api } from "../api/client";
import { attempt, showOperation } from "../state/actions";
import {
  activities,
  describeLeft,
  describeOwned,
  describeRemaining,
  movedBy,
  nameOperations,
  queue,
  type Activity,
} from "../state/activity";
import { comparison } from "../state/comparison";
import {
  cell,
  cellName,
  connection,
  isCellStopped,
  mayCommand,
  operationId,
  refusalOf,
  replay,
} from "../state/studio";
import { describeReason, describeRequest } from "../state/text";
import { shownSeries } from "../state/trials";
import type { OperationStatus } from "../api/types";
import { ArmControls } from "./ArmControls";
import { CellMenu } from "./CellMenu";
import { Icon } from "./icons";
import { choosing, maximised, runTab } from "./layout";
import { Popover } from "./Popover";
import { RunBadge } from "./status";

/** How many operations have a place of their own; the panel Runs has the others. */
const MOST = 3;

export function CellStrip() {
  if (cell.value === null) return null;
  const shown = activities.value.filter((each) => each.attention !== "waits");
  const waiting = queue.value;
  return (
    <nav class="strip" aria-label="What goes on in the cell">
      <ul class="strip-list">
        <CellStop />
        {shown.slice(0, MOST).map((each) => (
          <li key={each.operation.id}>
            <Item activity={each} />
          </li>
        ))}
        {shown.length === 0 && !isCellStopped.value && (
          <li class="muted truncate">
            {waiting.length > 0 ? "Nothing runs" : "Nothing goes on"} in {cell.value.name}.
          </li>
        )}
      </ul>
      {shown.length > MOST && (
        <button class="plain" onClick={() => (runTab.value = "runs")}>
          and {shown.length - MOST} more
        </button>
      )}
      {waiting.length > 0 && <Queue waiting={waiting} />}
      <ArmControls />
      <CellMenu />
    </nav>
  );
}

/** Why the cell takes no operations, and what has to be done. */
function CellStop() {
  const current = cell.value;
  if (current === null || !isCellStopped.value) return null;
  const what = current.reason === "" ? "" : `Stopped: ${current.reason}. `;
  const text = `${what}Nothing runs until the cause is removed and the stop is acknowledged.`;
  return (
    <li>
      <p class="is-bad strip-stop" role="alert" title={text}>
        <Icon name="warning" />
        <span class="truncate">{text}</span>
      </p>
    </li>
  );
}

/** Show an operation with what a person can decide about it, whatever has the page now. */
function lead(operation: OperationStatus): void {
  choosing.value = false;
  comparison.value = shownSeries.value = null;
  runTab.value = "run";
  if (maximised.value !== null) maximised.value = "run";
  showOperation(operation);
  focusDecision(document.activeElement, FRAMES);
}

const CHOICES = ".run .choices button:enabled, .run .decisions button:enabled";
/** For how many frames what can be decided is waited for: the events of the operation have to come first. */
const FRAMES = 120;

/** Give the keyboard to what can be decided, once it is there, unless a person has gone elsewhere meanwhile. */
function focusDecision(from: Element | null, frames: number): void {
  requestAnimationFrame(() => {
    if (document.activeElement !== from && document.activeElement !== document.body) return;
    const found = document.querySelector<HTMLElement>(CHOICES);
    if (found !== null) found.focus({ preventScroll: true });
    else if (frames > 0) focusDecision(from, frames - 1);
  });
}

function Item({ activity: { operation, attention, prompt } }: { activity: Activity }) {
  const isShown = operation.id === operationId.value && replay.value === null;
  const isUrgent = attention !== "goes on";
  const said =
    prompt?.text ?? (operation.state === "planned" ? "" : nameOperations(describeReason(operation)));
  const left = prompt === null ? "" : describeLeft(prompt);
  const title = [describeOwned(operation), said, prompt === null ? "" : describeRemaining(prompt)]
    .filter((each) => each !== "")
    .join("\n");
  return (
    <button
      class={`strip-item ${isUrgent ? "is-urgent" : ""}`}
      aria-pressed={isShown}
      title={title}
      onClick={() => lead(operation)}
    >
      <RunBadge state={operation.state} asks={prompt !== null} isKnown={connection.value.state === "open"} />
      <strong class="truncate">{describeRequest(operation.request)}</strong>
      {operation.request.owner && <span class="muted small truncate">{operation.request.owner}</span>}
      {said !== "" && <span class="small truncate">{said}</span>}
      {left !== "" && <span class="small mono strip-left">{left}</span>}
    </button>
  );
}

/** What waits, in its order, which can be changed. */
function Queue({ waiting }: { waiting: readonly OperationStatus[] }) {
  const order = waiting.map((each) => each.id);
  const move = (id: string, by: -1 | 1): void => {
    const name = cellName.value;
    if (name !== null) void attempt(() => api.reorder(name, movedBy(order, id, by)));
  };
  return (
    <Popover
      label={`Queue: ${waiting.length} waiting`}
      name="Queue of the cell"
      title="What waits in this cell, in its order"
      tone="is-waiting"
      isRight
      face={`${waiting.length} waiting`}
    >
      {(close) => (
        <ol>
          {waiting.map((each, at) => (
            <li key={each.id} class="queue-item">
              <span class="muted mono">{each.place}</span>
              <button
                class="link queue-text"
                title={each.id}
                onClick={() => {
                  close();
                  lead(each);
                }}
              >
                <span class="truncate">{describeOwned(each)}</span>
                <span class="small muted wrap-anywhere">{nameOperations(each.reason) || each.state}</span>
              </button>
              <Mover id={each.id} by={-1} isPossible={at > 0} move={move} />
              <Mover id={each.id} by={1} isPossible={at < waiting.length - 1} move={move} />
            </li>
          ))}
        </ol>
      )}
    </Popover>
  );
}

interface MoverProps {
  id: string;
  by: -1 | 1;
  isPossible: boolean;
  move: (id: string, by: -1 | 1) => void;
}

function Mover({ id, by, isPossible, move }: MoverProps) {
  const word = by < 0 ? "Earlier" : "Later";
  return (
    <button
      class="plain icon"
      aria-label={word}
      title={refusalOf("operate") || word}
      disabled={!isPossible || !mayCommand()}
      onClick={() => move(id, by)}
    >
      {by < 0 ? "↑" : "↓"}
    </button>
  );
}
