// What was refused, or was done where nothing else shows it.
import { useEffect } from "preact/hooks";
import { message } from "../state/studio";
import { Icon } from "./icons";

const [SHOWN_MS, UNDO_MS] = [5000, 20000];

export function Messages() {
  const current = message.value;
  useEffect(() => {
    if (current?.kind !== "done") return;
    const timer = window.setTimeout(
      () => (message.value = null),
      current.undo === undefined ? SHOWN_MS : UNDO_MS,
    );
    return () => window.clearTimeout(timer);
  }, [current]);
  return (
    <div class="messages" role={current?.kind === "error" ? "alert" : "status"}>
      {current !== null && (
        <div class={`notice row ${current.kind === "error" ? "bad" : "good"}`}>
          <Icon name={current.kind === "error" ? "cross" : "check"} />
          <span class="grow wrap-anywhere">{current.text}</span>
          {current.undo !== undefined && (
            <button class="small" onClick={current.undo}>
              Undo
            </button>
          )}
          <button class="plain icon" aria-label="Dismiss" onClick={() => (message.value = null)}>
            <Icon name="cross" />
          </button>
        </div>
      )}
    </div>
  );
}
