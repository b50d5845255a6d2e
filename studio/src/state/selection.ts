// The one selection of the page, and what it means for each view.
import type { LabelledValue, Position } from "../api/types";
import { ancestors, type OperationState, type TreeNode } from "./operation";

export type Selection =
  | { kind: "nothing" }
  | { kind: "node"; key: number }
  | { kind: "thing"; iri: string }
  | { kind: "place"; place: Position }
  | { kind: "time"; time: number };

export const NOTHING: Selection = { kind: "nothing" };

/** Return the node that is selected; null if something else is. */
export function selectedNode(selection: Selection, operation: OperationState): TreeNode | null {
  return selection.kind === "node" ? (operation.nodes.get(selection.key) ?? null) : null;
}

/** Return the time span that is selected, in s of the cell; what has not ended goes on until `now`. */
export function selectedSpan(
  selection: Selection,
  operation: OperationState,
  now: number,
): [number, number] | null {
  if (selection.kind === "time") return [selection.time, selection.time];
  const node = selectedNode(selection, operation);
  return node === null || node.status === "pending" ? null : [node.startedAt, node.endedAt ?? now];
}

/** Return the line of source that is selected. */
export function selectedPlace(selection: Selection, operation: OperationState): Position | null {
  if (selection.kind === "place") return selection.place;
  return selectedNode(selection, operation)?.source ?? null;
}

/** The same whenever no thing is selected, so that what shows it need not change. */
const NO_THINGS: readonly string[] = [];

/** Return the IRIs of what is selected: a thing, or what the parameters of a call or of the one around it stand for. */
export function selectedThings(selection: Selection, operation: OperationState): readonly string[] {
  if (selection.kind === "thing") return [selection.iri];
  const node = selectedNode(selection, operation);
  if (node === null) return NO_THINGS;
  const call = [node, ...ancestors(operation.nodes, node.key)].find((each) => each.choice !== null);
  return Object.values(call?.choice?.bindings ?? {}).flatMap(irisIn);
}

function irisIn(value: LabelledValue): string[] {
  if (typeof value !== "object") return [];
  if (value.type === "iri") return [value.iri];
  return value.type === "list" ? value.values.flatMap(irisIn) : [];
}
