import { expect, test } from "vitest";
import { bounds, followBounds } from "../src/state/bounds";
import { operationId, operations } from "../src/state/studio";
import type { OperationStatus } from "../src/api/types";

/** Show an operation in a state, with what its planner has proved. */
function show(state: string, least: number): void {
  const status = { id: "first", state, planning: { at_least_s: least } } as unknown as OperationStatus;
  operations.value = new Map([["first", status]]);
  operationId.value = "first";
}

test("the bounds of a planner that begins again begin again", () => {
  const end = followBounds();
  show("planning", 4);
  show("planning", 6);
  expect(bounds.value.points.map((each) => each.least)).toEqual([4, 6]);
  show("running", 6);
  expect(bounds.value.points).toHaveLength(2);
  show("planning", 1);
  expect(bounds.value.points.map((each) => each.least)).toEqual([1]);
  end();
});
