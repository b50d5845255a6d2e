// The 3-D view, which is loaded after the rest of the page.
import { useEffect, useRef, useState } from "preact/hooks";
import { select } from "../state/actions";
import { cellName, things } from "../state/studio";
import type { SceneHandle } from "../scene3d";

export function SceneView() {
  const box = useRef<HTMLDivElement>(null);
  const [problem, setProblem] = useState("");
  const name = cellName.value;
  useEffect(() => {
    const element = box.current;
    if (element === null || name === null) return;
    let handle: SceneHandle | null = null;
    let isOver = false;
    void mountInto(element, name).then(
      (made) => {
        if (isOver) made.dispose();
        else handle = made;
      },
      (error: unknown) => setProblem(error instanceof Error ? error.message : String(error)),
    );
    return () => {
      isOver = true;
      handle?.dispose();
    };
  }, [name]);
  return (
    <>
      <div class="scene" ref={box} />
      {problem !== "" && <div class="empty">The 3-D view cannot be shown: {problem}</div>}
    </>
  );
}

async function mountInto(element: HTMLElement, cell: string): Promise<SceneHandle> {
  const { followScene, mountScene, sceneSources } = await import("../scene3d");
  void [followScene, cell, sceneSources, things];
  return mountScene(element, sceneSources, {
    select: (iri) => select(iri === null ? { kind: "nothing" } : { kind: "thing", iri }),
  });
}
