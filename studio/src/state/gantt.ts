// A plan over time: when each step is expected to run, when it ran, and which devices it has; pure functions.
import type { PlanPreview, PlanStep } from "../api/types";
import type { Attempt, NodeStatus, OperationState } from "./operation";
import { formatValue } from "./text";

export interface Span {
  from: number;
  to: number;
}

/** A step of a plan: `planned` as the plan has it; `ran` as it happened, up to now if it goes on. In s of the cell. */
export interface GanttStep {
  key: number | null;
  name: string;
  values: string;
  devices: readonly string[];
  planned: Span;
  ran: Span | null;
  status: NodeStatus;
}

export interface Gantt {
  steps: readonly GanttStep[];
  from: number;
  to: number;
  /** The time that is now; null if nothing goes on. */
  now: number | null;
}

/** What is known of the devices of a cell, and of the durations that skills declare. */
export interface GanttKnowledge {
  /** Labels of devices by IRI. */
  devices: ReadonlyMap<string, string>;
  durations: ReadonlyMap<string, number>;
}

type Group = { parts: (number | Group)[]; parallel?: boolean; after?: number[][] };

/** Return when each step is expected: one after the other, or as the groups of the plan say. */
export function expectSteps(durations: readonly number[], arrangement: Group, begin: number): Span[] {
  const spans: (Span | undefined)[] = durations.map(() => undefined);
  const place = (part: number | Group, from: number): number => {
    if (typeof part === "number") {
      const to = from + (durations[part] ?? 0);
      spans[part] = { from, to };
      return to;
    }
    if (part.parallel === true) {
      const ends: number[] = [];
      for (const [index, each] of part.parts.entries()) {
        const before = (part.after?.[index] ?? []).map((other) => ends[other] ?? from);
        ends.push(place(each, Math.max(from, ...before)));
      }
      return Math.max(from, ...ends);
    }
    return part.parts.reduce<number>((at, each) => place(each, at), from);
  };
  let end = place(arrangement, begin);
  return spans.map((each, index) => each ?? { from: end, to: (end += durations[index] ?? 0) });
}

/** Return how long each step is expected to take: what its skill declares, otherwise its share of the rest of the cost. */
export function expectDurations(
  skills: readonly string[],
  cost: number,
  durations: ReadonlyMap<string, number>,
): number[] {
  const unknown = skills.filter((each) => !durations.has(each)).length;
  const known = skills.reduce((sum, each) => sum + (durations.get(each) ?? 0), 0);
  const share = unknown === 0 ? 0 : Math.max(0, cost - known) / unknown;
  return skills.map((each) => durations.get(each) ?? share);
}

/** Return the plan of an attempt over time; `now` is the present if it goes on. */
export function ganttOf(
  state: OperationState,
  attempt: Attempt,
  now: number | null,
  knowledge: GanttKnowledge,
): Gantt | null {
  const plan = attempt.plan;
  if (plan === null) return null;
  const nodes = attempt.nodes.map((key) => (key === null ? undefined : state.nodes.get(key)));
  const begin = Math.min(
    ...nodes.map((each) => each?.startedAt ?? Infinity),
    Math.max(plan.time, 0) || Infinity,
  );
  const from = Number.isFinite(begin) ? begin : plan.time;
  const durations = expectDurations(
    plan.steps.map((each) => each.skill),
    plan.cost,
    knowledge.durations,
  );
  const planned = expectSteps(durations, plan.arrangement ?? { parts: [] }, from);
  const steps = plan.steps.map((step, index): GanttStep => {
    const node = nodes[index];
    const ran = node === undefined || node.runs === 0;
    return {
      key: attempt.nodes[index] ?? null,
      name: step.skill,
      values: Object.values(step.arguments).map(formatValue).join(", "),
      devices: devicesOf(step, node?.choice?.bindings ?? {}, knowledge.devices),
      planned: planned[index] ?? { from, to: from },
      ran: ran ? null : { from: node.startedAt, to: node.endedAt ?? now ?? state.time },
      status: node?.status ?? "pending",
    };
  });
  const to = Math.max(from + 0.1, ...steps.flatMap((each) => [each.planned.to, each.ran?.to ?? 0]));
  return { steps, from, to, now: now !== null && now >= from ? now : null };
}

/** Return a plan that has not been started over time, from 0 s: as its schedule says, or one step after the other. */
export function ganttOfPreview(preview: PlanPreview, knowledge: GanttKnowledge): Gantt {
  const labels = new Set(knowledge.devices.values());
  const durations = expectDurations(
    preview.plan.map((each) => each.skill),
    preview.makespan_s ?? preview.duration_s ?? preview.plan.length,
    knowledge.durations,
  );
  const inOrder = expectSteps(durations, { parts: [] }, 0);
  const steps = preview.plan.map((step, index): GanttStep => {
    const { start_s: from = null, duration_s: takes = null } = step;
    const values = Object.values(step.arguments);
    return {
      key: null,
      name: step.skill,
      values: values.join(", "),
      devices: values.filter((each) => labels.has(each)).sort(),
      planned:
        from === null || takes === null ? (inOrder[index] ?? { from: 0, to: 0 }) : { from, to: from + takes },
      ran: null,
      status: "pending",
    };
  });
  return { steps, from: 0, to: Math.max(0.1, ...steps.map((each) => each.planned.to)), now: null };
}

function devicesOf(
  step: PlanStep,
  bindings: PlanStep["arguments"],
  known: ReadonlyMap<string, string>,
): string[] {
  const irisOf = [...Object.values(step.arguments), ...Object.values(bindings)].map((each) =>
    typeof each === "object" && each.type === "iri" ? each.iri : "",
  );
  return [...new Set(irisOf)].flatMap((iri) => known.get(iri) ?? []).sort();
}

/** Return when each device is busy, in the order of their names. */
export function busyDevices(gantt: Gantt): [device: string, steps: GanttStep[]][] {
  const found = new Map<string, GanttStep[]>();
  for (const step of gantt.steps)
    for (const device of step.devices) found.set(device, [...(found.get(device) ?? []), step]);
  return [...found.entries()].sort(([one], [other]) => one.localeCompare(other));
}

/** Return round times of a span, at most `most` of them. */
export function ticksOf({ from, to }: Span, most: number): number[] {
  const rough = (to - from) / most;
  const scale = 10 ** Math.floor(Math.log10(rough));
  const step = ([1, 2, 5, 10].find((each) => each * scale >= rough) ?? 10) * scale;
  const first = Math.ceil(from / step);
  return Array.from({ length: Math.floor(to / step) - first + 1 }, (_, at) => (first + at) * step);
}

/** How far a planner was, at a time in s since it began: its best plan, and what is proved of every plan, in s. */
export interface BoundPoint {
  at: number;
  best: number | null;
  least: number;
}

/** Return the points with another one; one that says nothing new is left out. */
export function addBound(points: readonly BoundPoint[], point: BoundPoint): readonly BoundPoint[] {
  const last = points.at(-1);
  if (last?.best === point.best && last.least === point.least) return points;
  return [...points, point];
}
