// What is about to be moved, and where: in the simulated reality, or in the world model, which asks for a reason.
import type { ReadonlySignal } from "@preact/signals";
import { useState } from "preact/hooks";
import type { MovingTool, SceneActions, Vector } from "./types";

/** A thing that is being moved with one of the two tools; null while none is chosen. */
export interface Move {
  tool: MovingTool;
  individual: string | null;
  label: string;
  by_m: Vector;
}

export interface MoveFormProps {
  move: ReadonlySignal<Move | null>;
  refusals: SceneActions["refusals"];
  onChange: (by_m: Vector) => void;
  onApply: (why: string) => Promise<void>;
  onTake: () => Promise<void>;
  onCancel: () => void;
}

const TEXTS = {
  disturb: {
    title: "Simulated reality",
    what: "The robot is not told: it finds out, or fails.",
    choose: "Choose a thing that a hand holds, or drag one that lies free; with Shift, up and down.",
    apply: "Move it really",
  },
  correct: {
    title: "World model",
    what: "Nothing moves: the cell believes what you say.",
    choose: "Drag a thing to where it is; with Shift, up and down.",
    apply: "Change belief",
  },
};

export function MoveForm({ move, refusals, onChange, onApply, onTake, onCancel }: MoveFormProps) {
  const [why, setWhy] = useState("");
  const [isBusy, setBusy] = useState(false);
  const now = move.value;
  if (now === null) return null;
  const texts = TEXTS[now.tool];
  const refusal = refusals.value[now.tool];
  const mayAct = refusal === "" && now.individual !== null && !isBusy;
  const isReady = mayAct && now.by_m.some((each) => each !== 0);
  const act = (done: Promise<void>): void => {
    setBusy(true);
    void done.finally(() => {
      setBusy(false);
      setWhy("");
    });
  };
  const apply = (event: Event): void => {
    event.preventDefault();
    if (isReady) act(onApply(why));
  };
  return (
    <form class={`scene-move scene-${now.tool}`} aria-label={texts.title} onSubmit={apply}>
      <p>
        <strong>{texts.title}.</strong> {texts.what}
      </p>
      {now.individual === null ? (
        <p>{texts.choose}</p>
      ) : (
        <>
          <p class="scene-numbers">
            <span class="truncate">{now.label} by</span>
            {(["x", "y", "z"] as const).map((axis, index) => (
              <label key={axis}>
                {axis}
                <input
                  type="number"
                  step="0.001"
                  value={(now.by_m[index] ?? 0).toFixed(3)}
                  onChange={(event) => {
                    const by = [...now.by_m] as [number, number, number];
                    by[index] = Number(event.currentTarget.value) || 0;
                    onChange(by);
                  }}
                />
              </label>
            ))}
            m
          </p>
          {now.tool === "correct" && (
            <label class="scene-why">
              Why
              <input
                required
                maxLength={500}
                value={why}
                onInput={(event) => setWhy(event.currentTarget.value)}
              />
            </label>
          )}
        </>
      )}
      {refusal !== "" && <p class="is-waiting">{refusal}</p>}
      <p class="scene-buttons">
        {now.individual !== null && (
          <button type="submit" disabled={!isReady}>
            {texts.apply}
          </button>
        )}
        {now.individual !== null && now.tool === "disturb" && (
          <button
            type="button"
            disabled={!mayAct}
            title="What a hand holds is taken out of it, and put there or 30 cm to the side"
            onClick={() => act(onTake())}
          >
            Take it out of the hand
          </button>
        )}
        <button type="button" onClick={onCancel}>
          Cancel
        </button>
      </p>
    </form>
  );
}
