// Events as lines of text, each with its importance and the node that it is about.
import type { Envelope, RunEvent } from "../api/types";
import { describeFailure, describePlan, describeReason, formatChange } from "./text";

export type Severity = "info" | "good" | "bad" | "world" | "command";

/** A line about an event; `node` is the key of its node, 0 for none. */
export interface LogEntry {
  sequence: number;
  time: number;
  text: string;
  severity: Severity;
  node: number;
}

/** Return the line of an event; null for those that the tree shows well enough. `base` is the key of node 0. */
export function logEntry(envelope: Envelope, base: number): LogEntry | null {
  const { event, sequence } = envelope;
  const described = describe(event);
  if (described === null) return null;
  const [text, severity, node] = described;
  return { sequence, time: event.time, text, severity, node: node === 0 ? 0 : base + node };
}

type Of<Type extends RunEvent["type"]> = Extract<RunEvent, { type: Type }>;
type Described = [text: string, severity: Severity, node: number] | null;

function describe(event: RunEvent): Described {
  switch (event.type) {
    case "implementation-chosen":
      return [`${event.skill}[${event.implementation}] starts`, "info", event.node];
    case "node-ended":
      if (event.failure != null && event.status === "failure")
        return [`${event.name}: ${describeFailure(event.failure)}`, "bad", event.node];
      return null;
    case "world-changed":
      return [`${event.origin}: ${event.changes.map(formatChange).join("; ")}`, "world", 0];
    default:
      return describeTask(event);
  }
}

function describeTask(event: RunEvent): Described {
  switch (event.type) {
    case "plan-arrived":
    case "plan-made":
    case "replanned":
      return describePlanning(event);
    case "requested":
    case "prompts-changed":
    case "disturbed":
      return describeOthers(event);
    case "task-started":
      return [event.library ? `${event.task} of ${event.library}` : event.task, "info", 0];
    case "state-changed":
      return [[event.state, describeReason(event)].filter(Boolean).join(": "), "info", 0];
    case "note":
      return [event.message, "info", event.node ?? 0];
    case "task-ended":
      return describeEnd(event);
    default:
      return null;
  }
}

function describePlanning(event: Of<"plan-arrived" | "plan-made" | "replanned">): Described {
  switch (event.type) {
    case "plan-arrived":
      return event.refused
        ? [`no plan: ${event.refused}${event.detail ? `; ${event.detail}` : ""}`, "bad", 0]
        : null;
    case "plan-made": {
      const steps = event.steps.map((each) => each.skill).join(", then ");
      const known = describePlan(event);
      const quality = known ? `, ${known}` : "";
      return [`plan: ${steps || "nothing to do"} (about ${event.cost.toFixed(0)} s${quality})`, "info", 0];
    }
    case "replanned":
      return event.sensed
        ? [`goes on: ${event.reason}`, "info", 0]
        : [`planning again: ${event.reason}`, "bad", 0];
  }
}

/** What came from outside of the task: commands, questions and disturbances. */
function describeOthers(event: Of<"requested" | "prompts-changed" | "disturbed">): Described {
  switch (event.type) {
    case "requested":
      if (event.refused) return [`${event.command.type} is refused: ${event.refused}`, "bad", 0];
      return [`${event.command.type} is requested`, "command", 0];
    case "prompts-changed":
      if (event.prompts.length === 0) return null;
      return [`asks: ${event.prompts.map((each) => each.text).join("; ")}`, "command", 0];
    case "disturbed":
      return [`disturbance: ${event.disturbance.type}${event.who ? ` (${event.who})` : ""}`, "command", 0];
  }
}

function describeEnd(event: RunEvent & { type: "task-ended" }): Described {
  if (event.failure != null) return [`${event.status}: ${describeFailure(event.failure)}`, "bad", 0];
  const claims = event.false_claims ?? [];
  if (claims.length > 0) return [`contradicted by the simulator: ${claims.join("; ")}`, "bad", 0];
  const text = event.verified === false ? "finished, not verified" : event.status;
  return [text, event.status === "succeeded" ? "good" : "info", 0];
}
