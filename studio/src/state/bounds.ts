// How the best plan and the proved bound grow while the planner of the operation that is shown works.
import { effect, signal } from "@preact/signals";
import { addBound, type BoundPoint } from "./gantt";
import { status } from "./studio";

/** What the page has seen of the planning of an operation. */
export const bounds = signal<{ operation: string; points: readonly BoundPoint[] }>({
  operation: "",
  points: [],
});
let began = 0;

/** Note how far the planner is whenever that is news; the function that is returned ends that. */
export function followBounds(): () => void {
  return effect(() => {
    const current = status.value;
    if (current?.state !== "planning") {
      if (current?.id !== bounds.peek().operation)
        bounds.value = { operation: current?.id ?? "", points: [] };
      return;
    }
    let known = bounds.peek();
    if (known.operation !== current.id || known.points.length === 0) began = performance.now();
    if (known.operation !== current.id) known = { operation: current.id, points: [] };
    const { best_s: best = null, at_least_s: least = 0 } = current.planning ?? {};
    const at = (performance.now() - began) / 1000;
    bounds.value = { ...known, points: addBound(known.points, { at, best, least }) };
  });
}
