// Formats values, facts, changes and failures in the syntax of the language, as the command line does.
import type {
  Contact,
  Failure,
  LabelledChange,
  LabelledFact,
  LabelledIri,
  LabelledValue,
  OperationRequest,
  PlanMade,
} from "../api/types";

import { describeDirt, statedDirtMap } from "./dirt_map";

const LISTED = 3;

/** Return the last part of an IRI. */
export function localName(iri: string): string {
  return iri.slice(Math.max(iri.lastIndexOf("#"), iri.lastIndexOf("/")) + 1);
}

/** Smaller numbers in SI units come from rounding. */
const ROUNDING = 1e-12;

/** Return a number as people write it: up to `digits` significant digits, without needless zeros. */
export function formatNumber(value: number, digits = 6): string {
  return String(Number((Math.abs(value) < ROUNDING ? 0 : value).toPrecision(digits)));
}

function withUnit(text: string, unit: string): string {
  return unit === "" ? text : `${text} ${unit}`;
}

/** Smaller components of vectors come from rounding. */
const NEGLIGIBLE = 1e-9;

function formatVector(components: readonly number[]): string {
  return `(${components.map((each) => formatNumber(Math.abs(each) < NEGLIGIBLE ? 0 : each, 4)).join(", ")})`;
}

/** Return a value as an author would write it; a long list as its length. */
export function formatValue(value: LabelledValue): string {
  if (typeof value === "string") return `"${value}"`;
  if (typeof value !== "object") return String(value);
  switch (value.type) {
    case "iri":
      return value.label;
    case "quantity":
      return withUnit(formatNumber(value.value), value.unit ?? "");
    case "vector":
      return withUnit(formatVector(value.components), value.unit ?? "");
    case "pose":
      return `pose at ${formatVector(value.position_m)}`;
    case "not-finite":
      return value.text;
    case "list":
      return value.values.length > LISTED
        ? `${value.values.length} values`
        : `[${value.values.map((each) => formatValue(each)).join(", ")}]`;
  }
}

function labelOf(end: LabelledIri | null): string {
  return end === null ? "_" : end.label;
}

/** Return the value of a property after its name; a map of dirt, which is long, in words. */
function statedValue(fact: LabelledFact & { type: "property" }): string {
  const map = statedDirtMap(fact);
  return map === null ? ` == ${formatValue(fact.value ?? "")}` : `: ${describeDirt(map)}`;
}

/** Return a fact in the syntax of the language, such as `not lab:Gripper-1 contain lab:Eraser-1`. */
export function formatFact(fact: LabelledFact): string {
  switch (fact.type) {
    case "relation": {
      const text = `${labelOf(fact.subject)} ${localName(fact.relation.iri)} ${labelOf(fact.object)}`;
      return fact.holds === false ? `not ${text}` : text;
    }
    case "property": {
      const owner = `${fact.individual.label}.${localName(fact.property.iri)}`;
      return fact.value === null
        ? `not ${fact.individual.label} has ${localName(fact.property.iri)}`
        : `${owner}${statedValue(fact)}`;
    }
    case "class":
      return `${fact.individual.label} is ${fact.holds === false ? "not " : ""}${fact.cls.label}`;
    case "same":
      return `${fact.one.label} ${fact.holds === false ? "!=" : "=="} ${fact.other.label}`;
  }
}

/** Return a change of the world as a clause. */
export function formatChange(change: LabelledChange): string {
  switch (change.type) {
    case "added":
      return `${change.individual.label} is added: ${change.classes.map((each) => each.label).join(", ")}`;
    case "removed":
      return `${change.individual.label} is removed`;
    default:
      return formatFact(change);
  }
}

/** Return all individuals that a fact or a change is about. */
export function individualsOf(fact: LabelledFact | LabelledChange): LabelledIri[] {
  switch (fact.type) {
    case "relation":
      return [fact.subject, fact.object].filter((each) => each !== null);
    case "same":
      return [fact.one, fact.other];
    default:
      return [fact.individual];
  }
}

function* innermost(failure: Failure): Generator<Failure> {
  const causes = failure.causes ?? [];
  if (causes.length === 0) yield failure;
  for (const cause of causes) yield* innermost(cause);
}

const nameWay = (failure: Failure): string =>
  failure.alternative ? `${failure.alternative}: ${failure.message}` : failure.message;

const CONTACTS: Record<Contact, string> = {
  none: "",
  kept: "the force is kept",
  lifting: "the tool is being taken off the surface",
  "taken-off": "the tool was taken off the surface; it senses contact again before the task goes on",
  approaching: "the tool approaches again until it senses contact",
};

/** Return why an operation is in its state, and before that what becomes of a tool that pressed when it was paused. */
export function describeReason({
  reason = "",
  contact = "none",
}: {
  reason?: string;
  contact?: Contact;
}): string {
  const told = CONTACTS[contact];
  return told === "" || reason === "" ? told || reason : `${told} (${reason})`;
}

/** Return the cause of a failure, the other ways that were tried, and whether another plan was found; nothing twice. */
export function describeFailure(failure: Failure): string {
  const causes = [...innermost(failure)];
  const tried = new Map<string, Failure>();
  for (const each of causes)
    if (each.kind !== "pre" && each.kind !== "inference" && each.kind !== "plan")
      tried.set(each.message, each);
  tried.delete(failure.message);
  const ways = [...tried.values()].map(nameWay);
  const listed = [
    ...ways.slice(0, LISTED),
    ...(ways.length > LISTED ? [`and ${ways.length - LISTED} more`] : []),
  ];
  const parts = [
    failure.message,
    ...(ways.length > 0 ? [`other ways were tried: ${listed.join("; ")}`] : []),
  ];
  return [
    ...new Set([...parts, ...causes.filter((each) => each.kind === "plan").map((each) => each.message)]),
  ].join("; ");
}

/** Return what is known of a plan: its proof, and how much of it was checked in space; empty for nothing. */
export function describePlan({ quality, space }: Pick<PlanMade, "quality" | "space">): string {
  if (!space) return quality ?? "";
  const looked = space.checked - new Set((space.unseen ?? []).map((each) => each.step)).size;
  const share = looked === space.steps ? `all ${space.steps}` : `${looked} of ${space.steps}`;
  const checked = space.stopped ? `not checked in space: ${space.stopped}` : `${share} checked in space`;
  return quality ? `${quality}, ${checked}` : checked;
}

/** Return a duration or a time of the cell's clock. */
export function formatTime(seconds: number): string {
  if (seconds < 100) return `${seconds.toFixed(1)} s`;
  const minutes = Math.floor(seconds / 60);
  return `${minutes}:${String(Math.floor(seconds % 60)).padStart(2, "0")} min`;
}

/** Return the arguments with which a task was started, as it names them. */
export function describeArguments(request: OperationRequest): string {
  return Object.entries(request.arguments ?? {})
    .map(([name, value]) => `${name}: ${value}`)
    .join(", ");
}

/** Return what the id of an operation says of it: all but its time and number. */
const nameOf = (id: string): string => id.replace(/-\d{8}T\d{6}Z-\w+$/, "");

/** Return what an operation is to do, in short. */
export function describeRequest(request: OperationRequest): string {
  if (request.task) return request.task;
  if (request.goal) return request.goal;
  return request.call || (request.continues ? `continues ${nameOf(request.continues)}` : "operation");
}
