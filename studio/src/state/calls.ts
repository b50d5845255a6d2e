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

/** A line of a comparison: the calls of both runs that call the same; null where a run has none. */
export interface CallPair {
  /** The number in the first run, and that in the second one if it is another. */
  number: string;
  depth: number;
  first: NumberedCall | null;
  second: NumberedCall | null;
}

/** A call, and the calls inside it. */
interface Block {
  call: NumberedCall;
  inside: readonly NumberedCall[];
}

/**
 * Return the calls of two runs side by side, in the order of both: those with the same skill and values, then, between
 * these, those with the same skill. What only one of the runs has stands alone.
 */
export function pairCalls(first: readonly NumberedCall[], second: readonly NumberedCall[]): CallPair[] {
  const [one, other] = [blocksOf(first), blocksOf(second)];
  return pairAlike(
    one,
    other,
    ({ call }) => `${call.skill} ${call.values}`,
    (left, right) =>
      pairAlike(
        left,
        right,
        ({ call }) => call.skill,
        (alone, rest) => [
          ...alone.flatMap(({ call, inside }) => [call, ...inside].map((each) => pairOf(each, null))),
          ...rest.flatMap(({ call, inside }) => [call, ...inside].map((each) => pairOf(null, each))),
        ],
      ),
  );
}

function pairOf(first: NumberedCall | null, second: NumberedCall | null): CallPair {
  const numbers = new Set([first?.number, second?.number].filter((each) => each !== undefined));
  return { number: [...numbers].join(" / "), depth: (first ?? second)?.depth ?? 0, first, second };
}

/** Return calls with those inside each; calls inside others follow these. */
function blocksOf(calls: readonly NumberedCall[]): Block[] {
  const outer = calls[0]?.depth ?? 0;
  const begins = calls.flatMap((each, at) => (each.depth === outer ? [{ each, at }] : []));
  return begins.map(({ each, at }, index) => ({
    call: each,
    inside: calls.slice(at + 1, begins[index + 1]?.at ?? calls.length),
  }));
}

/** Pair the longest common sequence of blocks by their names; `between` pairs what is left before, between and after. */
function pairAlike(
  first: readonly Block[],
  second: readonly Block[],
  name: (block: Block) => string,
  between: (first: readonly Block[], second: readonly Block[]) => CallPair[],
): CallPair[] {
  const found: CallPair[] = [];
  let [left, right] = [0, 0];
  for (const [at, with_] of commonOf(first.map(name), second.map(name))) {
    const [one, other] = [first[at], second[with_]];
    if (one === undefined || other === undefined) continue;
    found.push(...between(first.slice(left, at), second.slice(right, with_)));
    found.push(pairOf(one.call, other.call), ...pairCalls(one.inside, other.inside));
    [left, right] = [at + 1, with_ + 1];
  }
  return [...found, ...between(first.slice(left), second.slice(right))];
}

/** Return the indices of the longest common sequence of two lists. */
function commonOf(one: readonly string[], other: readonly string[]): [number, number][] {
  if (one.length === 0 || other.length === 0) return [];
  const width = other.length + 1;
  const lengths = new Uint32Array((one.length + 1) * width);
  const lengthAt = (at: number, with_: number): number => lengths[at * width + with_] ?? 0;
  for (let at = one.length - 1; at >= 0; at--)
    for (let with_ = other.length - 1; with_ >= 0; with_--)
      lengths[at * width + with_] =
        one[at] === other[with_]
          ? lengthAt(at + 1, with_ + 1) + 1
          : Math.max(lengthAt(at + 1, with_), lengthAt(at, with_ + 1));
  const found: [number, number][] = [];
  for (let [at, with_] = [0, 0]; at < one.length && with_ < other.length;) {
    if (one[at] === other[with_]) found.push([at++, with_++]);
    else if (lengthAt(at + 1, with_) >= lengthAt(at, with_ + 1)) at++;
    else with_++;
  }
  return found;
}

/** Whether the calls of a line differ: in skill, values, implementation or end, or one of the runs has none. */
export function isDifferentCall({ first, second }: CallPair): boolean {
  if (first === null || second === null) return true;
  const told = ({ skill, values, implementation, status }: NumberedCall): string =>
    [skill, values, implementation, status].join("\n");
  return told(first) !== told(second);
}
