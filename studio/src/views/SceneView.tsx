// The 3-D view, which is loaded after the rest of the page.
import { useEffect, useRef, useState } from "preact/hooks";
import { cellName, live } from "../state/studio";

/** How long the 3-D view waits for what is quick to show, in ms; making it takes the page longer than all the rest. */
const FIRST_MS = 1000;

export function SceneView() {
  const box = useRef<HTMLDivElement>(null);
  const [problem, setProblem] = useState("");
  const [isThere, setThere] = useState(false);
  const name = cellName.value;
  useEffect(() => {
    const element = box.current;
    if (element === null || name === null) return;
    let end: (() => void) | null = null;
    let isOver = false;
    void mountInto(element, name).then(
      (dispose) => {
        if (isOver) return dispose();
        end = dispose;
        setThere(true);
      },
      (error: unknown) => setProblem(error instanceof Error ? error.message : String(error)),
    );
    return () => {
      isOver = true;
      end?.();
    };
  }, [name]);
  return (
    <>
      <div class="scene" ref={box} />
      {!isThere && problem === "" && (
        <div class="empty" role="status">
          <span class="spinner" />
          The 3-D view is loaded
        </div>
      )}
      {problem !== "" && <div class="empty">The 3-D view cannot be shown: {problem}</div>}
    </>
  );
}

/** Wait until the tree of the operation is painted, if there is one. */
function restShown(): Promise<void> {
  return new Promise((resolve) => {
    const timer = window.setTimeout(resolve, FIRST_MS);
    const end = live.subscribe(({ lastEvent }) => {
      if (lastEvent === 0) return;
      window.clearTimeout(timer);
      requestAnimationFrame(() => requestAnimationFrame(() => resolve()));
      queueMicrotask(() => end());
    });
  });
}

/** Show a cell in an element; the function that is returned ends that. */
async function mountInto(element: HTMLElement, cell: string): Promise<() => void> {
  await restShown();
  const { followScene, mountScene, sceneActions, sceneSources } = await import("../scene3d");
  const handle = mountScene(element, sceneSources, sceneActions(cell));
  const unfollow = followScene(cell);
  return () => {
    unfollow();
    handle.dispose();
  };
}
