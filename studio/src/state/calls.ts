// The calls of an operation with the numbers that `skillc why` and `skillc diff` give them, and those of two runs in one list.
import type { LabelledValue } from "../api/types";
import { ATTEMPT, type NodeStatus, type OperationState, type TreeNode } from "./operation";
import { formatValue } from "./text";

/** A call: `number` is that of its step, then its place in the calls around it, such as `2.1`. */
export interface NumberedCall {
  number: string;
  depth: number;
  skill: string;
  implementation: string;
  /** What its parameters stand for, as text. */
  values: string;
  status: NodeStatus;
  /** When it started, in s since the task did. */
  startedAt: number | null;
  /** How long it took, in s of the cell; null if it has not started, or goes on. */
  took: number | null;
  /** The key of its node; null for a step that has not started. */
  key: number | null;
}

/** Return all calls in order: the steps of each plan, then calls outside of it, each before those inside it. */
export function numberCalls(state: OperationState): NumberedCall[] {
  const found: NumberedCall[] = [];
  let steps = 0;
  for (const [at, attempt] of state.attempts.entries()) {
    for (const [index, key] of attempt.nodes.entries()) {
      const node = key === null ? undefined : state.nodes.get(key);
      const step = attempt.plan?.steps[index];
      const skill = step?.skill ?? "";
      const values = formatValues(step?.arguments ?? {});
      if (node === undefined) found.push({ ...NOT_STARTED, number: `${++steps}`, skill, values });
      else addCalls(state, node, `${++steps}`, 0, found);
    }
    const planned = new Set(attempt.nodes);
    for (const each of outerCalls(state, at))
      if (!planned.has(each.key)) addCalls(state, each, `${++steps}`, 0, found);
  }
  return found;
}

const NOT_STARTED: NumberedCall = {
  number: "",
  depth: 0,
  skill: "",
  implementation: "",
  values: "",
  status: "pending",
  startedAt: null,
  took: null,
  key: null,
};

const formatValues = (values: Record<string, LabelledValue>): string =>
  Object.values(values).map(formatValue).join(", ");

function outerCalls(state: OperationState, attempt: number): TreeNode[] {
  return state.roots
    .filter((key) => Math.floor(key / ATTEMPT) === attempt)
    .flatMap((key) => {
      const root = state.nodes.get(key);
      if (root === undefined) return [];
      return root.kind === "call" ? [root] : callsInside(state, root);
    });
}

/** Return the calls in a node that no other call in it is around. */
function callsInside(state: OperationState, node: TreeNode): TreeNode[] {
  return node.children.flatMap((key) => {
    const child = state.nodes.get(key);
    if (child === undefined || child.status === "pending") return [];
    return child.kind === "call" ? [child] : callsInside(state, child);
  });
}

function addCalls(
  state: OperationState,
  node: TreeNode,
  number: string,
  depth: number,
  found: NumberedCall[],
): void {
  found.push({
    number,
    depth,
    skill: node.choice?.skill ?? /^[^[]*/.exec(node.name)?.[0] ?? node.name,
    implementation: node.choice?.implementation ?? "",
    values: formatValues(node.choice?.bindings ?? node.failedCall?.arguments ?? {}),
    status: node.status,
    startedAt: node.startedAt - (state.task?.time ?? 0),
    took: node.endedAt === null ? null : node.endedAt - node.startedAt,
    key: node.key,
  });
  callsInside(state, node).forEach((each, index) =>
    addCalls(state, each, `${number}.${index + 1}`, depth + 1, found),
  );
}

/** A line of a comparison: the calls of both runs with one number; null where a run has none. */
export interface CallPair {
  number: string;
  depth: number;
  first: NumberedCall | null;
  second: NumberedCall | null;
}

/** Return the calls of two runs side by side, in the order of their numbers. */
export function pairCalls(first: readonly NumberedCall[], second: readonly NumberedCall[]): CallPair[] {
  const pairs = new Map<string, CallPair>();
  for (const each of first)
    pairs.set(each.number, { number: each.number, depth: each.depth, first: each, second: null });
  for (const each of second) {
    const pair = pairs.get(each.number);
    if (pair === undefined)
      pairs.set(each.number, { number: each.number, depth: each.depth, first: null, second: each });
    else pair.second = each;
  }
  return [...pairs.values()].sort((one, other) => compareNumbers(one.number, other.number));
}

export function compareNumbers(one: string, other: string): number {
  const [left, right] = [one.split("."), other.split(".")];
  for (let at = 0; at < Math.min(left.length, right.length); at++) {
    const apart = Number(left[at]) - Number(right[at]);
    if (apart !== 0) return apart;
  }
  return left.length - right.length;
}

/** Whether one number means two calls: another skill, other values, or one of the runs has none. */
export function isAnotherCall({ first, second }: CallPair): boolean {
  if (first === null || second === null) return true;
  return first.skill !== second.skill || first.values !== second.values;
}
