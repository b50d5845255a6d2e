// How the best plan and the proved bound grow while the planner of the operation that is shown works.
import { effect, signal } from "@preact/signals";
import { addBound, type BoundPoint } from "./gantt";
import { status } from "./studio";

/** What the page has seen of the planning of an operation. */
export const bounds = signal<{
  operation: string;
  points: readonly BoundPoint[];
  /** Whether the points are costs, not seconds. */
  costs: boolean;
}>({ operation: "", points: [], costs: false });
let began = 0;
let planning = false;

/** Note how far the planner is whenever that is news, from the beginning whenever it begins; the function that is returned ends that. */
export function followBounds(): () => void {
  return effect(() => {
    const current = status.value;
    if (current?.state !== "planning") {
      planning = false;
      if (current?.id !== bounds.peek().operation)
        bounds.value = { operation: current?.id ?? "", points: [], costs: false };
      return;
    }
    const begins = !planning || bounds.peek().operation !== current.id;
    planning = true;
    if (begins) began = performance.now();
    const known = begins ? [] : bounds.peek().points;
    const { best_s: best = null, at_least_s: least = 0, costs = false } = current.planning ?? {};
    const at = (performance.now() - began) / 1000;
    bounds.value = { operation: current.id, points: addBound(known, { at, best, least }), costs };
  });
}
