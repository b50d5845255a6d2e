// The rows of the tree view: what is folded, left out or open, as a flat list that a virtual list shows.
import type { OperationState, TreeNode } from "./operation";

/** A row: a node, or the heading of an attempt; `hidden` is how many rows are folded below it. */
export interface TreeRow {
  key: number;
  depth: number;
  node: TreeNode;
  expandable: boolean;
  open: boolean;
}

export interface TreeOptions {
  /** Show every node, not only those that say what is done. */
  all: boolean;
  /** What a person has opened or closed, by key; the others are open while they run or have failed. */
  folds: ReadonlyMap<number, boolean>;
  /** Only nodes with this text in their name, and those around them. */
  filter: string;
}

/** Nodes that only give others an order. A tree of calls is easier to read without them. */
const STRUCTURE = new Set(["seq", "if", "primitive"]);

/** Return the rows of all attempts of an operation, from the root down. */
export function treeRows(state: OperationState, options: TreeOptions): TreeRow[] {
  const rows: TreeRow[] = [];
  const wanted = options.filter === "" ? null : keptByFilter(state, options.filter.toLowerCase());
  const visit = (key: number, depth: number): void => {
    const node = state.nodes.get(key);
    if (node === undefined || (wanted !== null && !wanted.has(key))) return;
    const isShown = options.all || !isStructure(node);
    const open = wanted !== null || (options.folds.get(key) ?? isOpen(node, depth));
    if (isShown) rows.push({ key, depth, node, expandable: hasShownChild(state, node, options.all), open });
    if (!isShown || open) for (const each of node.children) visit(each, isShown ? depth + 1 : depth);
  };
  for (const root of state.roots) visit(root, 0);
  return rows;
}

function isStructure(node: TreeNode): boolean {
  if (node.kind === "primitive") return node.status !== "failure";
  return STRUCTURE.has(node.kind);
}

/** Whether a node is open unless somebody has folded it: what runs or failed is, and so is the first level. */
function isOpen(node: TreeNode, depth: number): boolean {
  if (node.status === "pending") return false;
  return node.status === "running" || node.status === "failure" || depth === 0;
}

function hasShownChild(state: OperationState, node: TreeNode, all: boolean): boolean {
  return node.children.some((key) => {
    const child = state.nodes.get(key);
    if (child === undefined) return false;
    return all || !isStructure(child) || hasShownChild(state, child, all);
  });
}

function keptByFilter(state: OperationState, text: string): Set<number> {
  const kept = new Set<number>();
  for (const node of state.nodes.values()) {
    if (!node.name.toLowerCase().includes(text)) continue;
    let each: TreeNode | undefined = node;
    while (each !== undefined && !kept.has(each.key)) {
      kept.add(each.key);
      each = state.nodes.get(each.parent);
    }
  }
  return kept;
}

/** Return the part of a list of equal rows that is in sight, with `margin` rows more on both ends. */
export function visibleRange(
  scrollTop: number,
  height: number,
  rowHeight: number,
  count: number,
  margin = 8,
): [first: number, end: number] {
  const first = Math.max(0, Math.floor(scrollTop / rowHeight) - margin);
  return [first, Math.min(count, Math.ceil((scrollTop + height) / rowHeight) + margin)];
}
