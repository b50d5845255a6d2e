// The nodes that have not started yet: the tree that the server has made of the plan, below what the events have told.
import type { OperationTree } from "../api/types";
import { ATTEMPT, type OperationState, type TreeNode } from "./operation";

/** Return a state with the nodes of the tree of its plans; those that no event has named are `pending`.
 *  What is known of a plan, or of a call whose implementation was chosen, only later is left out: a replay is as live. */
export function withPlanned(state: OperationState, tree: OperationTree | null): OperationState {
  if (tree === null) return state;
  const nodes = new Map(state.nodes);
  const roots = new Set(state.roots);
  const children = new Map<number, Set<number>>();
  const later = new Set<number>();
  for (const each of tree.nodes) {
    const base = (each.attempt - 1) * ATTEMPT;
    const [key, parent] = [base + each.id, each.parent === 0 ? 0 : base + each.parent];
    const around = nodes.get(parent);
    if (each.attempt > state.attempts.length || later.has(parent) || isUnchosen(around)) {
      later.add(key);
      continue;
    }
    if (!nodes.has(key)) nodes.set(key, pendingNode(key, parent, each));
    if (parent === 0) roots.add(key);
    else children.set(parent, (children.get(parent) ?? new Set()).add(key));
  }
  for (const [parent, planned] of children) {
    const node = nodes.get(parent);
    if (node !== undefined)
      nodes.set(parent, { ...node, children: [...new Set([...planned, ...node.children])] });
  }
  return { ...state, nodes, roots: [...roots] };
}

function isUnchosen(node: TreeNode | undefined): boolean {
  return node?.kind === "call" && node.choice === null;
}

function pendingNode(key: number, parent: number, planned: OperationTree["nodes"][number]): TreeNode {
  return {
    key,
    parent,
    kind: planned.kind,
    name: planned.label,
    source: planned.source,
    status: "pending",
    runs: 0,
    startedAt: NaN,
    endedAt: null,
    startEvent: 0,
    endEvent: null,
    failure: null,
    failedCall: null,
    choice: null,
    values: Object.values(planned.arguments ?? {}),
    children: [],
  };
}
