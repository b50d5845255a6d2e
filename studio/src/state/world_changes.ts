// Changes of the world as edits that undo them, and what differs between two times; pure functions.
import type { LabelledChange, LabelledFact, LabelledValue, WorldWrite } from "../api/types";
import { formatValue, localName } from "./text";

/** Return a value as an edit has it, with all its digits; null if no edit can state it. */
export function editValue(value: LabelledValue): string | null {
  if (typeof value === "string") return JSON.stringify(value);
  if (typeof value !== "object") return String(value);
  switch (value.type) {
    case "iri":
      return value.label;
    case "quantity":
      return `${value.value} ${value.unit ?? ""}`.trim();
    case "vector":
      return `(${value.components.join(", ")}) ${value.unit ?? ""}`.trim();
    default:
      return null;
  }
}

/** Return the edit that states a fact, in the syntax in which it is shown; null if no edit can. */
export function editOfFact(fact: LabelledFact): string | null {
  switch (fact.type) {
    case "relation": {
      if (fact.subject === null || fact.object === null) return null;
      return `${fact.subject.label} ${localName(fact.relation.iri)} ${fact.object.label}`;
    }
    case "property": {
      const value = fact.value === null ? null : editValue(fact.value);
      return value === null ? null : `${fact.individual.label}.${localName(fact.property.iri)} == ${value}`;
    }
    case "class":
      return `${fact.individual.label} is ${fact.cls.label}`;
    case "same":
      return null;
  }
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
      return `${change.individual.label} is ${change.classes[0]?.label ?? "owl:Thing"}`;
    case "removed":
      return `not ${change.individual.label}`;
    case "relation": {
      const stated = editOfFact(change);
      return stated === null || change.holds !== false ? stated : `not ${stated}`;
    }
    default: {
      const value = change.value ?? valueIn(former, change.individual.iri, change.property.iri);
      const stated = editOfFact({ ...change, value });
      return stated === null || change.value !== null ? stated : `not ${stated}`;
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
