// A plan without steps: why, and what can be done about it in a simulation.
import { describeObstacle, reset } from "../state/resetting";
import { cell, replay } from "../state/studio";

export function NothingToDo() {
  const obstacle = describeObstacle();
  const isOffered = cell.value?.resettable === true && replay.value === null;
  return (
    <>
      <p class="muted">Nothing to do: the goal holds already.</p>
      {isOffered && (
        <p>
          <button
            disabled={obstacle !== ""}
            title={
              obstacle ||
              "Puts everything back to how the scene says it is, in the world model and in the simulation"
            }
            onClick={() => void reset()}
          >
            Reset {cell.value?.name} to its scene
          </button>
        </p>
      )}
    </>
  );
}
