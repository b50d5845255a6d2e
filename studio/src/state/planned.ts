// The nodes that have not started yet: the tree that the server has made of the plan, below what the events have told.
import type { OperationTree } from "../api/types";
import { ATTEMPT, type OperationState, type TreeNode } from "./operation";

/** Return a state with the nodes of the whole tree; those that no event has named are `pending`. */
export function withPlanned(state: OperationState, tree: OperationTree | null): OperationState {
  if (tree === null) return state;
  const nodes = new Map(state.nodes);
  const roots = new Set(state.roots);
  const children = new Map<number, Set<number>>();
  for (const each of tree.nodes) {
    const base = (each.attempt - 1) * ATTEMPT;
    const [key, parent] = [base + each.id, each.parent === 0 ? 0 : base + each.parent];
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
