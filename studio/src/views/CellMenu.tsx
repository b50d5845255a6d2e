// What can be done with a simulated cell as a whole: reset it to its scene, save it, restore it.
import { useEffect, useState } from "preact/hooks";
import type { Checkpoint } from "../api/types";
import {
  checkpoints,
  describeObstacle,
  readCheckpoints,
  remove,
  reset,
  restore,
  save,
} from "../state/resetting";
import { cell } from "../state/studio";
import { Popover } from "./Popover";

export function CellMenu() {
  const current = cell.value;
  if (current === null || current.state === "off" || !current.resettable) return null;
  return (
    <Popover
      label="Reset or save the cell"
      name="Reset or save the cell"
      title="Reset this cell to its scene, save it, or restore it"
      isRight
      face="Reset or save"
    >
      {(close) => <Menu close={close} />}
    </Popover>
  );
}

/** A name that a checkpoint may have. */
const NAME = /^[A-Za-z0-9_][A-Za-z0-9_.-]*$/;

function Menu({ close }: { close: () => void }) {
  const [name, setName] = useState("");
  useEffect(() => void readCheckpoints(), []);
  const obstacle = describeObstacle();
  const isValid = NAME.test(name);
  const then = (done: Promise<boolean>): void => void done.then((isDone) => isDone && close());
  return (
    <>
      <p>
        A reset puts everything back to how the scene says it is, in the world model and in the simulation.
      </p>
      <button class="primary" disabled={obstacle !== ""} onClick={() => then(reset())}>
        Reset to the scene
      </button>
      {obstacle !== "" && <p class="small notice waiting">{obstacle}</p>}
      <form
        class="row"
        onSubmit={(event) => {
          event.preventDefault();
          if (isValid && obstacle === "") void save(name).then((isDone) => isDone && setName(""));
        }}
      >
        <input
          aria-label="Name of the checkpoint"
          placeholder="Save as"
          maxLength={100}
          value={name}
          onInput={(event) => setName(event.currentTarget.value)}
        />
        <button disabled={obstacle !== "" || !isValid} title={obstacle || "Save the cell as it is now"}>
          Save
        </button>
      </form>
      {name !== "" && !isValid && (
        <p class="small is-bad">
          A name has only letters, digits, “_”, “-” and “.”, no spaces, and does not begin with “-” or “.”.
        </p>
      )}
      <Saved obstacle={obstacle} restored={then} />
    </>
  );
}

interface SavedProps {
  obstacle: string;
  restored: (done: Promise<boolean>) => void;
}

function Saved({ obstacle, restored }: SavedProps) {
  const found = checkpoints.value;
  if (found === null) return <span class="spinner" />;
  if (found.length === 0) return <p class="small muted">This cell was not saved yet.</p>;
  return (
    <ul class="stack" aria-label="Checkpoints">
      {found.map((each) => (
        <li key={each.name} class="checkpoint">
          <span class="queue-text">
            <strong class="truncate" title={each.name}>
              {each.name}
            </strong>
            <span class="small muted truncate">{describeSaved(each)}</span>
          </span>
          <button disabled={obstacle !== ""} title={obstacle} onClick={() => restored(restore(each.name))}>
            Restore
          </button>
          <button
            class="plain"
            disabled={obstacle !== ""}
            title={obstacle || `Forget ${each.name}`}
            onClick={() => void remove(each.name)}
          >
            Remove
          </button>
        </li>
      ))}
    </ul>
  );
}

function describeSaved({ who, saved_ns }: Checkpoint): string {
  const when = new Date(saved_ns / 1e6).toLocaleString(undefined, { dateStyle: "short", timeStyle: "short" });
  return `${when} · ${who}`;
}
