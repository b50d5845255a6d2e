// The 3-D view of a cell: what is true and what is believed, in one picture.
import type { SceneActions, SceneHandle, SceneSources } from "./types";
import { SceneView } from "./view";

export { followScene, sceneActions, sceneSources } from "./feed";
export type * from "./types";

/** Show a cell in an element, which it fills, until the handle is disposed of. */
export function mountScene(element: HTMLElement, sources: SceneSources, actions: SceneActions): SceneHandle {
  return new SceneView(element, sources, actions);
}
