// The bar on top: which cell, which operation, how it is, and what can be done with it at once.
import { api } from "../api/client";
import { attempt, command, logOut, showCell, stop } from "../state/actions";
import {
  allows,
  cell,
  cellName,
  cells,
  connection,
  describeUnseen,
  isCellStopped,
  mayCommand,
  message,
  operation,
  refusalOf,
  replay,
  session,
  shownRun,
  shownTime,
  status,
} from "../state/studio";
import { formatTime } from "../state/text";
import { Icon, type IconName } from "./icons";
import { helpShown, nextTheme, theme } from "./layout";
import { LeaseControl } from "./LeaseControl";
import { CellBadge, RunBadge } from "./status";

export function TopBar() {
  return (
    <header class="topbar">
      <h1 class="product">skillc studio</h1>
      <CellChoice />
      <OperationTitle />
      <Transport />
      <Connection />
      <button
        class="plain icon"
        aria-label={`Theme: ${theme.value}`}
        title={`Theme: ${theme.value} (t)`}
        onClick={nextTheme}
      >
        <Icon name="theme" />
      </button>
      <button class="plain icon" aria-label="Help" title="Help (?)" onClick={() => (helpShown.value = true)}>
        <Icon name="help" />
      </button>
    </header>
  );
}

function CellChoice() {
  const current = cell.value;
  if (current === null) return <span class="muted">no cell</span>;
  return (
    <div class="row">
      <label class="row">
        <span class="visually-hidden">Cell</span>
        <select
          class="cell-choice"
          value={current.name}
          onChange={(event) => showCell(event.currentTarget.value)}
        >
          {[...cells.value.values()].map((each) => (
            <option key={each.name} value={each.name}>
              {each.name}
            </option>
          ))}
        </select>
      </label>
      <span title={current.reason || current.scene}>
        <CellBadge state={current.state} isKnown={connection.value.state === "open"} />
      </span>
      {isCellStopped.value && (
        <button
          disabled={!mayCommand()}
          title={refusalOf("operate") || current.reason}
          onClick={() =>
            void attempt(() => api.acknowledge(current.name), "The cell takes operations again.")
          }
        >
          Acknowledge
        </button>
      )}
      <LeaseControl />
      {current.paceable && <Pace name={current.name} pace={current.pace} />}
    </div>
  );
}

const PACES = [null, 0.25, 0.5, 1, 2, 5, 10];

function Pace({ name, pace }: { name: string; pace: number | null }) {
  const set = (text: string): void => {
    void attempt(() => api.setPace(name, text === "" ? null : Number(text)));
  };
  const choices = PACES.includes(pace) ? PACES : [...PACES, pace];
  return (
    <label title={refusalOf("operate") || "How fast the time of the cell passes"}>
      <span class="visually-hidden">Pace</span>
      <select
        value={pace ?? ""}
        disabled={!mayCommand()}
        onChange={(event) => set(event.currentTarget.value)}
      >
        {choices.map((each) => (
          <option key={each} value={each ?? ""}>
            {each === null ? "fastest" : each === 1 ? "real time" : `${each} × real`}
          </option>
        ))}
      </select>
    </label>
  );
}

function OperationTitle() {
  const current = shownRun.value;
  if (current === null) return <span class="operation muted">nothing has run yet</span>;
  const { task } = operation.value;
  return (
    <span class="operation" title={replay.value === null ? status.value?.id : current.title}>
      <strong class="truncate">{current.title}</strong>
      {replay.value !== null && (
        <span class="badge is-waiting">
          <Icon name="play" />
          recording
        </span>
      )}
      {current.state !== null && (
        <RunBadge
          {...current}
          state={current.state}
          isKnown={replay.value !== null || connection.value.state === "open"}
        />
      )}
      <span class="clock mono" title="How long it has run, in the time of the cell">
        {task !== null && formatTime(Math.max(0, shownTime.value - task.time))}
      </span>
    </span>
  );
}

interface ControlProps {
  icon: IconName;
  label: string;
  hotkey: string;
  enabled: boolean;
  act: () => unknown;
}

function Control({ icon, label, hotkey, enabled, act }: ControlProps) {
  return (
    <button
      class="icon"
      disabled={!enabled}
      title={refusalOf("operate") || describeUnseen() || `${label} (${hotkey})`}
      aria-label={label}
      aria-keyshortcuts={hotkey}
      onClick={() => void act()}
    >
      <Icon name={icon} />
    </button>
  );
}

/** Pause or resume what is shown, whichever is possible; if something else goes on, that is said. */
export function togglePause(): void {
  if (allows("pause")) void command({ type: "pause", reason: "paused in the studio" });
  else if (allows("resume")) void command({ type: "resume" });
  else if (describeUnseen() !== "") message.value = { kind: "error", text: describeUnseen() };
}

function Transport() {
  if (replay.value !== null) return <StopControl />;
  const resumes = allows("resume");
  const can = mayCommand();
  return (
    <div class="transport" role="toolbar" aria-label="Operation">
      <Control
        icon={resumes ? "play" : "pause"}
        label={resumes ? "Resume" : "Pause"}
        hotkey="p"
        enabled={can && (resumes || allows("pause"))}
        act={togglePause}
      />
      <Control
        icon="over"
        label="Step over"
        hotkey="n"
        enabled={can && allows("step-over")}
        act={() => command({ type: "step-over" })}
      />
      <Control
        icon="into"
        label="Step into"
        hotkey="i"
        enabled={can && allows("step-into")}
        act={() => command({ type: "step-into" })}
      />
      <Control
        icon="out"
        label="Step out"
        hotkey="o"
        enabled={can && allows("step-out")}
        act={() => command({ type: "step-out" })}
      />
      <StopControl />
    </div>
  );
}

/** Stops the cell, whatever is shown of it; it is never disabled. */
function StopControl() {
  const name = cellName.value ?? "the cell";
  return (
    <button
      class="stop"
      title={`Stop all that goes on in ${name}, whoever started it (x; while you write, Ctrl-Shift-X)`}
      aria-label="Stop"
      aria-keyshortcuts="x Control+Shift+X"
      onClick={() => void stop()}
    >
      <Icon name="stop" />
      Stop
    </button>
  );
}

function Connection() {
  const isOpen = connection.value.state === "open";
  const who = session.value;
  return (
    <div class="row">
      {!isOpen && (
        <span class="badge is-bad" role="status">
          <Icon name="plug" />
          no connection; trying again
        </span>
      )}
      {who && (
        <button
          class="plain who"
          title={`${who.name} has the role ${who.role}. Log out`}
          onClick={() => void logOut()}
        >
          <span class="truncate">{who.name}</span>
          {who.role !== who.name && <span class="muted small">{who.role}</span>}
        </button>
      )}
    </div>
  );
}
