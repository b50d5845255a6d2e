// What lies over the canvas: labels, controls, and what is said when there is nothing to see.
import { render } from "preact";
import type { Box } from "./labels";
import { MoveForm } from "./MoveForm";
import type { Mover } from "./mover";
import "./scene.css";
import { Toolbar, type ToolbarProps } from "./Toolbar";
import type { CellModel, Displacement, SceneActions, SceneHandle } from "./types";

export interface Overlay {
  root: HTMLElement;
  labels: HTMLElement;
  /** Say why there is nothing to see; nothing with an empty text. */
  say(text: string): void;
  setHalves(areBeside: boolean): void;
  /** Call a function with each new size in pixels, and where controls are, until what is returned is called. */
  onResize(changed: (width: number, height: number, covered: readonly Box[]) => void): () => void;
  dispose(): void;
}

/** Put a canvas and what lies over it into an element. */
export function makeOverlay(element: HTMLElement, canvas: HTMLElement): Overlay {
  const root = make("scene-view");
  const [labels, controls, empty, note] = [
    make("scene-labels"),
    make(""),
    make("scene-empty"),
    make("scene-note"),
  ];
  const halves = [make("scene-half is-true", "Really"), make("scene-half is-believed", "As believed")];
  note.textContent = "Grid 10 cm and 1 m";
  root.append(canvas, labels, ...halves, empty, note, controls);
  element.append(root);
  return {
    root,
    labels,
    say: (text) => {
      empty.textContent = text;
      empty.hidden = text === "";
    },
    setHalves: (areBeside) => halves.forEach((each) => (each.hidden = !areBeside)),
    onResize: (changed) => {
      const covers = [note, ...controls.querySelectorAll<HTMLElement>(".scene-group, .scene-menu")];
      const observer = new ResizeObserver(() =>
        changed(root.clientWidth, root.clientHeight, covers.map(boxIn(root))),
      );
      [root, ...covers].forEach((each) => observer.observe(each));
      return () => observer.disconnect();
    },
    dispose: () => {
      render(null, controls);
      root.remove();
    },
  };
}

/** Say why there is nothing to see; nothing if there is. */
export function sayWhyEmpty(model: CellModel | null): string {
  if (model === null) return "The shapes of the cell are not there yet.";
  return model.bodies.length === 0 ? "Cells of this backend cannot be drawn." : "";
}

/** Show the controls of a view in an overlay; `onMove` does something with what is chosen, and where. */
export function showControls(
  overlay: Overlay,
  handle: SceneHandle,
  {
    options,
    tool,
    follows,
    actions,
  }: Pick<ToolbarProps, "options" | "tool" | "follows"> & { actions: SceneActions },
  mover: Mover,
  onMove: (act: (displacement: Displacement) => Promise<boolean>) => Promise<void>,
): void {
  const controls = overlay.root.lastElementChild;
  if (controls === null) return;
  render(
    <>
      <Toolbar
        options={options}
        tool={tool}
        follows={follows}
        refusals={actions.refusals}
        isReal={actions.isReal}
        onCamera={(preset) => handle.setCamera(preset === "follow" && follows.value ? "fit" : preset)}
        onOptions={(changed) => handle.setOptions(changed)}
        onTool={(chosen) => handle.setTool(chosen)}
      />
      <MoveForm
        move={mover.move}
        refusals={actions.refusals}
        onChange={(by_m) => mover.shift(by_m)}
        onApply={(why) => onMove((displacement) => mover.apply(displacement, why, actions))}
        onTake={() => onMove((displacement) => actions.take(displacement))}
        onCancel={() => handle.setTool("select")}
      />
    </>,
    controls,
  );
}

/** Return a function that finds where an element is in another one. */
function boxIn(root: HTMLElement): (element: HTMLElement) => Box {
  const { left: x, top: y } = root.getBoundingClientRect();
  return (element) => {
    const { left, right, top, bottom } = element.getBoundingClientRect();
    return { left: left - x, right: right - x, top: top - y, bottom: bottom - y };
  };
}

function make(name: string, text = ""): HTMLElement {
  const made = document.createElement("div");
  made.className = name;
  made.textContent = text;
  return made;
}
