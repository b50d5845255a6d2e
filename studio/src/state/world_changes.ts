// Changes of the world as edits that undo them, and what differs between two times; pure functions.
import type { LabelledChange, LabelledValue, WorldWrite } from "../api/types";
import { formatValue, localName } from "./text";

/** Return a value as an edit has it; null if no edit can state it. */
function editValue(value: LabelledValue): string | null {
  if (typeof value === "string") return JSON.stringify(value);
  if (typeof value !== "object") return String(value);
  if (value.type === "iri") return value.label;
  return value.type === "quantity" ? String(value.value) : null;
}

/** Return changes as edits, one a line; null if one of them cannot be written as an edit. */
export function editsOf(
  changes: readonly LabelledChange[],
  former: readonly LabelledChange[],
): string[] | null {
  const lines = changes.map((each) => editOf(each, former));
  return lines.every((each) => each !== null) && lines.length > 0 ? lines : null;
}

function editOf(change: LabelledChange, former: readonly LabelledChange[]): string | null {
  switch (change.type) {
    case "added":
      return `${change.individual.label} a ${change.classes[0]?.label ?? "owl:Thing"}`;
    case "removed":
      return `not ${change.individual.label}`;
    case "relation": {
      if (change.subject === null || change.object === null) return null;
      const text = `${change.subject.label} <${change.relation.iri}> ${change.object.label}`;
      return change.holds === false ? `not ${text}` : text;
    }
    default: {
      const about = `${change.individual.label} <${change.property.iri}>`;
      const stated = change.value ?? valueIn(former, change.individual.iri, change.property.iri);
      const value = stated === null ? null : editValue(stated);
      if (value === null) return null;
      return change.value === null ? `not ${about} ${value}` : `${about} ${value}`;
    }
  }
}

function valueIn(
  changes: readonly LabelledChange[],
  individual: string,
  property: string,
): LabelledValue | null {
  for (const each of changes)
    if (each.type === "property" && each.individual.iri === individual && each.property.iri === property)
      return each.value;
  return null;
}

/** A fact that is not the same at two times; texts, empty for nothing. */
export interface WorldDifference {
  what: string;
  before: string;
  after: string;
  /** Who changed it last. */
  by: string;
  individual: string;
}

/** Return what differs between the worlds before and after some writes, which are in their order. */
export function differencesOf(writes: readonly WorldWrite[]): WorldDifference[] {
  const found = new Map<string, WorldDifference>();
  for (const write of writes)
    for (const change of write.changes) {
      const { key, what, individual } = subjectOf(change);
      const before = found.get(key)?.before ?? stateIn(write.undo ?? [], key, change);
      found.set(key, { what, before, after: describe(change), by: write.origin || "the scene", individual });
    }
  return [...found.values()].filter((each) => each.before !== each.after);
}

function subjectOf(change: LabelledChange): { key: string; what: string; individual: string } {
  switch (change.type) {
    case "relation": {
      const [subject, object] = [change.subject?.label ?? "_", change.object?.label ?? "_"];
      const what = `${subject} ${localName(change.relation.iri)} ${object}`;
      return {
        key: `relation ${change.relation.iri} ${subject} ${object}`,
        what,
        individual: change.subject?.iri ?? "",
      };
    }
    case "property": {
      const what = `${change.individual.label}.${localName(change.property.iri)}`;
      const key = `property ${change.individual.iri} ${change.property.iri}`;
      return { key, what, individual: change.individual.iri };
    }
    default:
      return {
        key: `individual ${change.individual.iri}`,
        what: change.individual.label,
        individual: change.individual.iri,
      };
  }
}

/** Return how something was before a write, as the changes say that lead back; what they do not name was the same. */
function stateIn(undo: readonly LabelledChange[], key: string, change: LabelledChange): string {
  const back = undo.find((each) => subjectOf(each).key === key);
  return back === undefined ? describe(change) : describe(back);
}

function describe(change: LabelledChange): string {
  switch (change.type) {
    case "relation":
      return change.holds === false ? "no" : "yes";
    case "property":
      return change.value === null ? "" : formatValue(change.value);
    case "added":
      return "exists";
    case "removed":
      return "";
  }
}
