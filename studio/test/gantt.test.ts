import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import type { Envelope, PlanPreview } from "../src/api/types";
import {
  addBound,
  busyDevices,
  expectDurations,
  expectSteps,
  ganttOf,
  ganttOfPreview,
  ticksOf,
} from "../src/state/gantt";
import { applyEvents, EMPTY } from "../src/state/operation";

const events = JSON.parse(
  readFileSync(new URL("fixtures/clean_whiteboard.json", import.meta.url), "utf8"),
) as Envelope[];
const state = applyEvents(EMPTY, events);

describe("the expected times of steps", () => {
  test("follow each other, or begin together in a parallel group", () => {
    const spans = expectSteps([2, 3, 1, 4], { parts: [0, { parts: [1, 2], parallel: true }, 3] }, 10);
    expect(spans).toEqual([
      { from: 10, to: 12 },
      { from: 12, to: 15 },
      { from: 12, to: 13 },
      { from: 15, to: 19 },
    ]);
  });

  test("follow each other if the plan does not say how they run", () => {
    expect(expectSteps([1, 2], { parts: [] }, 0)).toEqual([
      { from: 0, to: 1 },
      { from: 1, to: 3 },
    ]);
  });

  test("are those that skills declare, and the others share the rest", () => {
    expect(expectDurations(["Pick", "Look", "Wait"], 10, new Map([["Pick", 4]]))).toEqual([4, 3, 3]);
  });
});

describe("a plan that has not been started", () => {
  const step = { arguments: { arm: "lab:UR5e", part: "lab:Part-1" }, source: "a.skill:3" };
  const plan = (...steps: object[]): PlanPreview =>
    ({
      plan: steps.map((each) => ({ skill: "Pick", ...step, ...each })),
      duration_s: 6,
    }) as unknown as PlanPreview;
  const knowledge = {
    devices: new Map([["http://lab#UR5e", "lab:UR5e"]]),
    durations: new Map([["Pick", 2]]),
  };

  test("has its steps one after the other, with their devices, and none has run", () => {
    const { steps, from, to, now } = ganttOfPreview(plan({}, { skill: "Place" }), knowledge);
    expect(steps.map((each) => each.planned)).toEqual([
      { from: 0, to: 2 },
      { from: 2, to: 6 },
    ]);
    expect(steps.map((each) => each.devices)).toEqual([["lab:UR5e"], ["lab:UR5e"]]);
    expect(steps.every((each) => each.ran === null && each.status === "pending")).toBe(true);
    expect([from, to, now]).toEqual([0, 6, null]);
  });

  test("has the times of its schedule", () => {
    const { steps } = ganttOfPreview(
      plan({ start_s: 0, duration_s: 3 }, { start_s: 1, duration_s: 4 }),
      knowledge,
    );
    expect(steps.map((each) => each.planned)).toEqual([
      { from: 0, to: 3 },
      { from: 1, to: 5 },
    ]);
  });
});

describe("a real run over time", () => {
  const attempt = state.attempts.at(-1);
  if (attempt?.plan == null) throw new Error("the run has a plan");
  const irisOf = Object.values(attempt.plan.steps[0]?.arguments ?? {}).flatMap((each) =>
    typeof each === "object" && each.type === "iri" ? [each] : [],
  );
  const devices = new Map(irisOf.map((each) => [each.iri, each.label]));
  const gantt = ganttOf(state, attempt, null, { devices, durations: new Map() });

  test("has each step where it ran, in a span that holds all", () => {
    expect(gantt?.steps.length).toBe(attempt.plan?.steps.length);
    for (const each of gantt?.steps ?? []) {
      expect(each.status).toBe("success");
      expect(each.ran?.from).toBeGreaterThanOrEqual(gantt?.from ?? NaN);
      expect(each.ran?.to).toBeLessThanOrEqual(gantt?.to ?? NaN);
    }
    expect(gantt?.now).toBeNull();
  });

  test("shows when each device is busy", () => {
    if (gantt === null) throw new Error("it has a plan");
    const busy = busyDevices(gantt);
    expect(busy.map(([device]) => device)).toEqual([...new Set(devices.values())].sort());
    expect(busy.every(([, steps]) => steps.length > 0)).toBe(true);
  });

  test("has a line that is now while it goes on", () => {
    const half = applyEvents(EMPTY, events.slice(0, Math.floor(events.length / 2)));
    const ongoing = half.attempts.at(-1);
    if (ongoing === undefined) throw new Error("it has begun");
    const now = half.time + 5;
    const gantt = ganttOf(half, ongoing, now, { devices, durations: new Map() });
    expect(gantt?.now).toBe(now);
    const running = gantt?.steps.filter((each) => each.status === "running") ?? [];
    expect(running.map((each) => each.ran?.to)).toEqual([now]);
  });
});

test("ticks are round, and no more than there is room for", () => {
  expect(ticksOf({ from: 3, to: 47 }, 6)).toEqual([10, 20, 30, 40]);
  expect(ticksOf({ from: 0, to: 1 }, 6).length).toBeLessThanOrEqual(6);
});

test("only news is added to the bounds of a planner", () => {
  const first = addBound([], { at: 0, best: null, least: 0 });
  const same = addBound(first, { at: 1, best: null, least: 0 });
  expect(same).toBe(first);
  expect(addBound(same, { at: 2, best: 30, least: 4 })).toHaveLength(2);
});
