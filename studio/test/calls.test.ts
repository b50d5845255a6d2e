import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import { makeLine } from "../src/state/series";
import type { Envelope } from "../src/api/types";
import { isDifferentCall, numberCalls, pairCalls } from "../src/state/calls";
import { overlay } from "../src/state/comparison";
import { endOfSecond } from "../src/state/history";
import { applyEvents, EMPTY } from "../src/state/operation";

const events = JSON.parse(
  readFileSync(new URL("fixtures/clean_whiteboard.json", import.meta.url), "utf8"),
) as Envelope[];
const calls = numberCalls(applyEvents(EMPTY, events));

describe("the numbers of calls", () => {
  test("count steps, and the calls in each", () => {
    expect(calls.length).toBeGreaterThan(5);
    const steps = calls.filter((each) => each.depth === 0).map((each) => each.number);
    expect(steps).toEqual(steps.map((_, index) => `${index + 1}`));
    for (const each of calls) expect(each.number.split(".").length).toBe(each.depth + 1);
    expect(calls.every((each) => each.skill !== "" && each.took !== null)).toBe(true);
  });

  test("pair calls that call the same, whatever their numbers; one that only one run has stands alone", () => {
    expect(pairCalls(calls, calls).map(isDifferentCall)).toEqual(calls.map(() => false));
    const steps = calls.filter((each) => each.depth === 0);
    const [step] = steps;
    if (step === undefined) throw new Error("the run has no steps");
    const later = steps.map((each, at) => ({ ...each, number: `${at + 2}` }));
    const moved = pairCalls(steps, [{ ...step, skill: "Another", values: "" }, ...later]);
    expect(moved.map(isDifferentCall)).toEqual([true, ...steps.map(() => false)]);
    expect(moved.slice(1).map((each) => each.number)).toEqual(
      steps.map((each, at) => `${each.number} / ${at + 2}`),
    );
    const changed = pairCalls(steps, [{ ...step, values: "lab:Other" }, ...steps.slice(1)]);
    expect(changed.map(isDifferentCall)).toEqual(steps.map((_, at) => at === 0));
  });
});

test("signals of two runs lie over each other from their beginnings", () => {
  const one = {
    lines: [makeLine("force", "Arm")],
    columns: [
      [10, 10.1],
      [1, 2],
    ],
  };
  const other = {
    lines: [makeLine("force", "Arm")],
    columns: [
      [90, 90.05],
      [3, 4],
    ],
  };
  expect(overlay("force at Arm", one, other)).toEqual([
    [0, 0.05, 0.1],
    [1, null, 2],
    [3, 4, null],
  ]);
  expect(overlay("speed", one, other)).toBeNull();
});

test("older runs are those up to the second in which a run began", () => {
  expect(endOfSecond("carry-20260131T120059Z-abc")).toBe(`${Date.UTC(2026, 0, 31, 12, 1)}000000`);
  expect(endOfSecond("no time")).toBe("");
});
