import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import type { Envelope } from "../src/api/types";
import { compareNumbers, isAnotherCall, numberCalls, pairCalls } from "../src/state/calls";
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

  test("have an order that is not that of texts", () => {
    expect(["10", "2.1", "2", "1.10", "1.9"].sort(compareNumbers)).toEqual(["1.9", "1.10", "2", "2.1", "10"]);
  });

  test("pair the calls of two runs; one that only one has is another call", () => {
    const pairs = pairCalls(calls, calls.slice(1));
    expect(pairs.map((each) => each.number)).toEqual(calls.map((each) => each.number));
    expect(pairs[0]?.second).toBeNull();
    expect(pairs.map(isAnotherCall)).toEqual(pairs.map((_, index) => index === 0));
  });
});

test("signals of two runs lie over each other from their beginnings", () => {
  const one = {
    lines: [{ name: "force", unit: "N" }],
    columns: [
      [10, 10.1],
      [1, 2],
    ],
  };
  const other = {
    lines: [{ name: "force", unit: "N" }],
    columns: [
      [90, 90.05],
      [3, 4],
    ],
  };
  expect(overlay("force", one, other)).toEqual([
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
