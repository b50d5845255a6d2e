// Tells clicks from drags, and turns pixels into rays.
import * as three from "three";

const CLICK_PX = 4;

export interface PointerTarget {
  /** Something is pressed at a place of the canvas; return whether it is taken, so that the camera stays. */
  onPress(ray: three.Raycaster): boolean;
  onDrag(ray: three.Raycaster, isVertical: boolean): void;
  onRelease(): void;
  onClick(ray: three.Raycaster): void;
}

/** Listen to a canvas until the function that is returned is called. */
export function listen(
  canvas: HTMLCanvasElement,
  camera: three.Camera,
  controls: { enabled: boolean },
  target: PointerTarget,
): () => void {
  const ray = new three.Raycaster();
  const ending = new AbortController();
  let start: { x: number; y: number } | null = null;
  let isTaken = false;
  const aim = (event: PointerEvent): three.Raycaster => {
    const box = canvas.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * 2 - 1;
    const y = 1 - ((event.clientY - box.top) / box.height) * 2;
    ray.setFromCamera(new three.Vector2(x, y), camera);
    return ray;
  };
  const on = (
    type: "pointerdown" | "pointermove" | "pointerup" | "pointercancel",
    run: (event: PointerEvent) => void,
  ) => canvas.addEventListener(type, run, { signal: ending.signal, capture: true });
  on("pointerdown", (event) => {
    if (event.button !== 0 || !event.isPrimary) return;
    start = { x: event.clientX, y: event.clientY };
    isTaken = target.onPress(aim(event));
    controls.enabled = !isTaken;
    if (isTaken) canvas.setPointerCapture(event.pointerId);
  });
  on("pointermove", (event) => {
    if (isTaken) target.onDrag(aim(event), event.shiftKey);
  });
  on("pointerup", (event) => {
    const isClick = start !== null && Math.hypot(event.clientX - start.x, event.clientY - start.y) < CLICK_PX;
    if (isTaken) target.onRelease();
    else if (isClick && event.button === 0) target.onClick(aim(event));
    [start, isTaken, controls.enabled] = [null, false, true];
  });
  on("pointercancel", () => {
    if (isTaken) target.onRelease();
    [start, isTaken, controls.enabled] = [null, false, true];
  });
  return () => ending.abort();
}
