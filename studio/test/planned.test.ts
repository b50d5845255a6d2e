import { expect, test } from "vitest";
import type { Envelope, OperationTree } from "../src/api/types";
import { applyEvents, EMPTY } from "../src/state/operation";
import { pendingNodes, withPlanned } from "../src/state/planned";
import { treeRows } from "../src/state/rows";

const source = { path: "a.skill", line: 1, column: 1 };
const kindOf = (name: string) => (name === "all" ? "parallel" : "call");
const node = (id: number, parent: number, label: string) => ({
  id,
  parent,
  attempt: 1,
  kind: kindOf(label),
  label,
  source,
});
const TREE: OperationTree = {
  sequence: 0,
  nodes: [node(9, 0, "all"), node(1, 9, "A"), node(2, 1, "A1"), node(3, 9, "B"), node(4, 9, "C")],
};
const PLANS = pendingNodes(TREE);
const event = (sequence: number, id: number, parent: number, name: string): Envelope => ({
  run: "r",
  sequence,
  wall_time_ns: 0,
  event: { type: "node-started", time: 0, node: id, parent, kind: kindOf(name), name, source },
});
const rows = (state: Parameters<typeof treeRows>[0]): string[] =>
  treeRows(state, { all: false, folds: new Map(), filter: "" }).map(
    (each) => `${"  ".repeat(each.depth)}${each.node.name} ${each.node.status}`,
  );

const PLANNED = { ...EMPTY, attempts: [{ plan: null, arrived: null, nodes: [], reason: "" }] };

test("before anything has started the tree of the plan is there, pending", () => {
  expect(rows(withPlanned(PLANNED, PLANS))).toEqual(["all pending"]);
});

test("before there is a plan its tree is not there, nor what is in a call before its implementation is chosen", () => {
  expect(rows(withPlanned(EMPTY, PLANS))).toEqual([]);
  expect(withPlanned(PLANNED, PLANS).nodes.has(2)).toBe(false);
});

test("what runs is as the events say, what comes is pending, in the order of the plan", () => {
  const state = applyEvents(PLANNED, [event(1, 9, 0, "all"), event(2, 3, 9, "B")]);
  expect(rows(withPlanned(state, PLANS))).toEqual([
    "all running",
    "  A pending",
    "  B running",
    "  C pending",
  ]);
});

test("a node that the tree does not have yet stays", () => {
  const state = applyEvents(PLANNED, [event(1, 9, 0, "all"), event(2, 7, 9, "new")]);
  expect(rows(withPlanned(state, PLANS))).toContain("  new running");
});

test("without a tree a state is as it was", () => {
  expect(withPlanned(EMPTY, null)).toBe(EMPTY);
});
