// Help: the keys, what the shapes mean, and where this page comes from.
import { useEffect, useRef, useState } from "preact/hooks";
import { api } from "../api/client";
import { helpShown } from "./layout";
import { NodeMark, nodeWord } from "./status";
import { LICENCES } from "./licences";

const KEYS: readonly [keys: string[], what: string][] = [
  [["p"], "pause or resume; in contact the force is kept"],
  [["n", "i", "o"], "step over, into, out of a call"],
  [["x"], "stop all that goes on in the cell, whoever started it; needs no role"],
  [["Ctrl-Shift-X"], "the same, also while you write"],
  [["1", "2", "3", "4", "5"], "go to Run, Tree, Details, 3-D, Signals"],
  [["w", "f", "s", "e"], "show Why, World (facts), Source, Events"],
  [["r"], "choose what to run next"],
  [["h"], "show the history of runs"],
  [["g"], "show the plan over time, or the signals"],
  [["m"], "enlarge the panel with the keyboard, or show all again"],
  [["↑", "↓", "←", "→"], "move in the tree, fold and open"],
  [["/"], "search: in the tree, or in the facts"],
  [["t"], "light, dark, or as the system"],
  [["?"], "this help"],
];

export function Help() {
  const dialog = useRef<HTMLDialogElement>(null);
  const [version, setVersion] = useState("");
  const isShown = helpShown.value;
  useEffect(() => {
    if (isShown) {
      // Beside it the page can be used, Stop above all.
      dialog.current?.show();
      api.version().then(
        (found) => setVersion(found.skillc),
        () => setVersion("unknown"),
      );
    } else dialog.current?.close();
  }, [isShown]);
  return (
    <dialog ref={dialog} class="help" aria-labelledby="help-title" onClose={() => (helpShown.value = false)}>
      <div class="row spread">
        <h2 id="help-title">skillc studio</h2>
        <button autofocus onClick={() => (helpShown.value = false)}>
          Close
        </button>
      </div>
      <p>
        Click anything: a step, a fact, a moment or a thing. All panels show what belongs to it, and{" "}
        <em>Why</em> says why it is so. <em>Stop</em> stops the software; it is no safety function.
      </p>
      <table>
        <tbody>
          {KEYS.map(([keys, what]) => (
            <tr key={what}>
              <td class="keys">
                {keys.map((each) => (
                  <kbd key={each}>{each}</kbd>
                ))}
              </td>
              <td>{what}</td>
            </tr>
          ))}
        </tbody>
      </table>
      <p class="row legend">
        {(["pending", "running", "success", "failure", "halted"] as const).map((each) => (
          <span key={each} class="row">
            <NodeMark status={each} /> {nodeWord(each)}
          </span>
        ))}
      </p>
      <details class="small">
        <summary>About: version {version || "…"}, and the licences of what this page is made with</summary>
        <ul>
          {LICENCES.map(([name, licence]) => (
            <li key={name}>
              {name}: {licence}
            </li>
          ))}
        </ul>
      </details>
    </dialog>
  );
}
