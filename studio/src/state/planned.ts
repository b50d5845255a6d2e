// The nodes that have not started yet: the tree that the server has made of the plan, below what the events have told.
import type { OperationTree } from "../api/types";
import { ATTEMPT, type OperationState, type TreeNode } from "./operation";

/** A node of the plan of an attempt, as it is until an event names it. */
export interface PlannedNode {
  attempt: number;
  node: TreeNode;
}

/** Return the nodes of the tree that the server has made of plans; all are `pending`. */
export function pendingNodes(tree: OperationTree): PlannedNode[] {
  return tree.nodes.map((each) => {
    const base = (each.attempt - 1) * ATTEMPT;
    const parent = each.parent === 0 ? 0 : base + each.parent;
    return { attempt: each.attempt, node: pendingNode(base + each.id, parent, each) };
  });
}

/** Return a state with the nodes of its plans. What is known of a plan, or of a call whose implementation was chosen,
 *  only later is left out: a replay is as live. */
export function withPlanned(state: OperationState, plans: readonly PlannedNode[] | null): OperationState {
  if (plans === null) return state;
  const nodes = new Map(state.nodes);
  const roots = new Set(state.roots);
  const children = new Map<number, Set<number>>();
  const later = new Set<number>();
  for (const { attempt, node } of plans) {
    const { key, parent } = node;
    const around = nodes.get(parent);
    if (attempt > state.attempts.length || later.has(parent) || isUnchosen(around)) {
      later.add(key);
      continue;
    }
    if (!nodes.has(key)) nodes.set(key, node);
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
