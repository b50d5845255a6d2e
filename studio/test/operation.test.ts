import { readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import type { Envelope, RunEvent } from "../src/api/types";
import { activeCalls, applyEvents, EMPTY, type OperationState } from "../src/state/operation";
import { stateAt, timeEvents } from "../src/state/replay";
import { selectedPlace, selectedSpan, selectedThings } from "../src/state/selection";

// The events of a real run of `clean_whiteboard`.
const events = JSON.parse(
  readFileSync(new URL("fixtures/clean_whiteboard.json", import.meta.url), "utf8"),
) as Envelope[];

function envelopes(...happened: RunEvent[]): Envelope[] {
  return happened.map((event, index) => ({ run: "r", sequence: index + 1, wall_time_ns: 0, event }));
}
const source = { path: "a.skill", line: 3, column: 1 };
const started = (node: number, parent: number, name: string, time = 0): RunEvent => ({
  type: "node-started",
  time,
  node,
  parent,
  kind: "call",
  name,
  source,
});
const ended = (node: number, name: string, status: string, time = 1): RunEvent => ({
  type: "node-ended",
  time,
  node,
  name,
  status,
  source,
});
const plan = (...skills: string[]): RunEvent => ({
  type: "plan-made",
  time: 0,
  planner: "p",
  optimal: "",
  cost: 1,
  steps: skills.map((skill) => ({ skill, arguments: {} })),
});
const chosen = (node: number, skill: string): RunEvent => ({
  type: "implementation-chosen",
  time: 0,
  node,
  skill,
  implementation: "i",
  bindings: {},
  source,
});

/** A state without what differs only in identity. */
function plain(state: OperationState): unknown {
  return { ...state, nodes: [...state.nodes.entries()] };
}

describe("a real run", () => {
  const state = applyEvents(EMPTY, events);
  const timed = timeEvents(events);

  test("ends as it did, with all nodes ended", () => {
    expect(state.state).toBe("succeeded");
    expect(state.ended?.verified).toBe(true);
    expect(state.nodes.size).toBe(
      new Set(events.flatMap((each) => ("node" in each.event ? [each.event.node] : []))).size,
    );
    expect([...state.nodes.values()].filter((each) => each.status === "running")).toEqual([]);
  });

  test("each step of the plan has its call, in order", () => {
    const steps = state.attempts[0]?.plan?.steps.map((each) => each.skill);
    const calls = state.attempts[0]?.nodes.map((key) => state.nodes.get(key ?? 0)?.choice?.skill);
    expect(calls).toEqual(steps);
    expect(steps).toEqual(["Drive", "Pick", "Drive", "Wipe"]);
  });

  test("is the same event by event, in batches, twice, and played back and forth", () => {
    const singly = events.reduce((before, each) => applyEvents(before, [each]), EMPTY);
    expect(plain(singly)).toEqual(plain(state));
    expect(applyEvents(state, events)).toBe(state);
    const half = stateAt(timed, 30);
    expect(plain({ ...stateAt(timed, 1e9, half), time: 0 })).toEqual(plain({ ...state, time: 0 }));
    expect(plain(stateAt(timed, 30, state))).toEqual(plain(half));
  });

  test("is at each time what it was live after the last event until then", () => {
    let live = EMPTY;
    for (const [index, each] of events.entries()) {
      live = applyEvents(live, [each]);
      const time = timed.times[index] ?? NaN;
      if (timed.times[index + 1] !== time) expect(plain(stateAt(timed, time))).toEqual(plain(live));
    }
  });

  test("a prefix shows what ran then", () => {
    const early = stateAt(timed, 9);
    expect(activeCalls(early).map((each) => each.name)).toEqual(["MoveTo"]);
    expect(early.attempts[0]?.nodes.filter((each) => each !== null).length).toBe(2);
  });

  test("a selected call that goes on selects its span until now", () => {
    const early = stateAt(timed, 9);
    const key = early.attempts[0]?.nodes[1] ?? 0;
    expect(selectedSpan({ kind: "node", key }, early, 12)?.[1]).toBe(12);
  });

  test("a selected call selects its span, its line and its things", () => {
    const key = state.attempts[0]?.nodes[1] ?? 0;
    const selection = { kind: "node", key } as const;
    const [from, to] = selectedSpan(selection, state, 1000) ?? [];
    expect(from).toBeCloseTo(7.34);
    expect(to).toBe(state.nodes.get(key)?.endedAt);
    expect(selectedPlace(selection, state)?.path).toBe("std/handling.skill");
    expect(selectedThings(selection, state)).toContain("http://example.org/lab#Eraser-1");
  });
});

test("an event whose time is before that of the one before it is played after that", () => {
  const timed = timeEvents(
    envelopes(started(1, 0, "A", 5), started(2, 1, "B", 4), ended(2, "B", "success", 6)),
  );
  expect(timed.times).toEqual([5, 5, 6]);
  expect(stateAt(timed, 4.5).lastEvent).toBe(0);
  expect(stateAt(timed, 5).lastEvent).toBe(2);
});

test("a state before stays as it was", () => {
  const before = applyEvents(EMPTY, envelopes(plan("A"), started(1, 0, "A")));
  const copy = JSON.stringify(plain(before));
  applyEvents(before, [{ run: "r", sequence: 3, wall_time_ns: 0, event: ended(1, "A", "success") }]);
  expect(JSON.stringify(plain(before))).toBe(copy);
});

test("after planning again, nodes with the same numbers are others", () => {
  const state = applyEvents(
    EMPTY,
    envelopes(
      plan("A", "B"),
      started(1, 0, "A"),
      chosen(1, "A"),
      ended(1, "A", "failure"),
      { type: "replanned", time: 2, reason: "A failed" },
      plan("B"),
      started(1, 0, "B"),
      chosen(1, "B"),
    ),
  );
  expect([...state.nodes.values()].map((each) => [each.name, each.status])).toEqual([
    ["A", "failure"],
    ["B", "running"],
  ]);
  expect(state.attempts.map((each) => each.reason)).toEqual(["A failed", ""]);
  expect(state.attempts[0]?.nodes[1]).toBeNull();
});

test("a node that starts again is one node that runs a second time", () => {
  const again = envelopes(plan("A"), started(1, 0, "A"), ended(1, "A", "failure"), started(1, 0, "A", 2));
  const node = [...applyEvents(EMPTY, again).nodes.values()];
  expect(node.map((each) => [each.status, each.runs, each.startedAt, each.failure])).toEqual([
    ["running", 2, 2, null],
  ]);
});

test("a second step of the same skill is the second one in the plan; a call inside a step is none", () => {
  const state = applyEvents(
    EMPTY,
    envelopes(
      plan("A", "A"),
      started(1, 0, "A"),
      chosen(1, "A"),
      started(2, 1, "A"),
      chosen(2, "A"),
      started(3, 0, "A"),
      chosen(3, "A"),
    ),
  );
  expect(state.attempts[0]?.nodes).toEqual([1, 3]);
});
