// A line between two panels that moves with the mouse or the arrow keys.
import { DEFAULT_SIZES, sizes, type Sizes } from "./layout";

interface SplitterProps {
  of: keyof Sizes;
  label: string;
  vertical: boolean;
  min: number;
  max: number;
  /** How much of the size one pixel is; `both` is how long what is on both sides is together, in pixels. */
  perPixel: (both: number) => number;
}

export function Splitter({ of, label, vertical, min, max, perPixel }: SplitterProps) {
  const set = (value: number): void => {
    sizes.value = { ...sizes.value, [of]: Math.min(max, Math.max(min, value)) };
  };
  const drag = (event: PointerEvent & { currentTarget: HTMLElement }): void => {
    const handle = event.currentTarget;
    const sides = [handle.previousElementSibling, handle.nextElementSibling].map(
      (each) => each?.getBoundingClientRect()[vertical ? "width" : "height"] ?? 0,
    );
    const scale = perPixel(sides.reduce((sum, each) => sum + each, 0));
    const [from, began] = [vertical ? event.clientX : event.clientY, sizes.value[of]];
    handle.setPointerCapture(event.pointerId);
    handle.onpointermove = (moved) =>
      set(began + ((vertical ? moved.clientX : moved.clientY) - from) * scale);
    handle.onpointerup = () => (handle.onpointermove = null);
  };
  const press = (event: KeyboardEvent): void => {
    const [less, more] = vertical ? ["ArrowLeft", "ArrowRight"] : ["ArrowUp", "ArrowDown"];
    const step = (max - min) / 20;
    if (event.key === less) set(sizes.value[of] - step);
    else if (event.key === more) set(sizes.value[of] + step);
    else return;
    event.preventDefault();
  };
  const percent = Math.round(((sizes.value[of] - min) / (max - min)) * 100);
  return (
    <div
      class={`splitter ${vertical ? "vertical" : "horizontal"} split-${of}`}
      role="separator"
      tabIndex={0}
      aria-label={label}
      aria-orientation={vertical ? "vertical" : "horizontal"}
      aria-valuenow={percent}
      aria-valuemin={0}
      aria-valuemax={100}
      title="Drag, or use the arrow keys; double-click to reset"
      onPointerDown={drag}
      onKeyDown={press}
      onDblClick={() => set(DEFAULT_SIZES[of])}
    />
  );
}
