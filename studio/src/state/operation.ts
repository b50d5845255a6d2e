// An operation as its events tell: a pure function from events to what there is to show, live or from a recording.
import type {
  ArrivedPlan,
  Envelope,
  Failure,
  FailedCallContext,
  ImplementationChosen,
  PlanMade,
  PlanStep,
  Position,
  Prompt,
  RunEvent,
  RunState,
  TaskEnded,
  TaskStarted,
} from "../api/types";
import { logEntry, type LogEntry } from "./log";
import { describeReason } from "./text";

export type NodeStatus = "pending" | "running" | "success" | "failure" | "halted";

/** A node of a tree; `key` is unique over all attempts, `runs` is how often it has started. Times in s of the cell. */
export interface TreeNode {
  key: number;
  parent: number;
  kind: string;
  name: string;
  source: Position;
  status: NodeStatus;
  runs: number;
  startedAt: number;
  endedAt: number | null;
  startEvent: number;
  endEvent: number | null;
  failure: Failure | null;
  failedCall: FailedCallContext | null;
  choice: ImplementationChosen | null;
  /** What a call gets that has not started, as text. */
  values: readonly string[];
  children: readonly number[];
}

/** A plan and how far it is: `nodes` are the keys of the calls of its steps, null for a step that has not started. */
export interface Attempt {
  plan: PlanMade | null;
  /** The plan as the planner found it: what was left out of the search, and what is proved. */
  arrived: ArrivedPlan | null;
  nodes: readonly (number | null)[];
  reason: string;
}

export interface OperationState {
  lastEvent: number;
  time: number;
  state: RunState | null;
  reason: string;
  task: TaskStarted | null;
  ended: TaskEnded | null;
  /** The plan that has arrived last. */
  arrived: ArrivedPlan | null;
  attempts: readonly Attempt[];
  nodes: ReadonlyMap<number, TreeNode>;
  roots: readonly number[];
  prompts: readonly Prompt[];
  log: readonly LogEntry[];
}

export const EMPTY: OperationState = {
  lastEvent: 0,
  time: 0,
  state: null,
  reason: "",
  task: null,
  ended: null,
  arrived: null,
  attempts: [],
  nodes: new Map(),
  roots: [],
  prompts: [],
  log: [],
};

/** The nodes of each attempt have keys from a multiple of this. */
export const ATTEMPT = 1_000_000;

/** Return the state after more events, in their order; those that it has already are left out. */
export function applyEvents(before: OperationState, envelopes: readonly Envelope[]): OperationState {
  const fresh = envelopes.filter((each) => each.sequence > before.lastEvent);
  if (fresh.length === 0) return before;
  const draft = new Draft(before);
  for (const each of fresh) draft.apply(each);
  return draft.finish();
}

/** A copy that takes a batch of events; what has not changed is shared with the state before. */
class Draft {
  private readonly state: OperationState;
  private readonly nodes: Map<number, TreeNode>;
  private readonly log: LogEntry[];
  private readonly attempts: Attempt[];

  constructor(before: OperationState) {
    this.nodes = new Map(before.nodes);
    this.log = [...before.log];
    this.attempts = [...before.attempts];
    this.state = { ...before };
  }

  finish(): OperationState {
    return { ...this.state, nodes: this.nodes, log: this.log, attempts: this.attempts };
  }

  apply(envelope: Envelope): void {
    const event = envelope.event;
    this.state.lastEvent = envelope.sequence;
    this.state.time = Math.max(this.state.time, event.time);
    this.change(event, envelope.sequence);
    const entry = logEntry(envelope, this.base);
    if (entry !== null) this.log.push(entry);
  }

  private get base(): number {
    return Math.max(0, this.attempts.length - 1) * ATTEMPT;
  }

  private change(event: RunEvent, sequence: number): void {
    switch (event.type) {
      case "task-started":
        this.state.task = event;
        break;
      case "state-changed":
        this.state.state = event.state;
        this.state.reason = describeReason(event);
        break;
      case "plan-arrived":
        this.state.arrived = event.plan ?? null;
        break;
      case "plan-made":
        this.attempts.push({
          plan: event,
          arrived: this.state.arrived,
          nodes: event.steps.map(() => null),
          reason: "",
        });
        break;
      case "replanned":
        this.replaceAttempt({ reason: event.reason });
        break;
      case "prompts-changed":
        this.state.prompts = event.prompts;
        break;
      case "task-ended":
        this.state.ended = event;
        this.state.state = event.status;
        this.state.prompts = [];
        break;
      default:
        this.changeNode(event, sequence);
    }
  }

  private changeNode(event: RunEvent, sequence: number): void {
    if (event.type === "node-started") {
      if (this.attempts.length === 0)
        this.attempts.push({ plan: null, arrived: null, nodes: [], reason: "" });
      this.startNode(event, sequence);
    } else if (event.type === "node-ended") {
      this.update(this.base + event.node, {
        status: event.status as NodeStatus,
        name: event.name,
        endedAt: event.time,
        endEvent: sequence,
        failure: event.failure ?? null,
        failedCall: event.failed_call ?? null,
      });
    } else if (event.type === "implementation-chosen") {
      this.dropBody(this.base + event.node);
      this.update(this.base + event.node, { choice: event });
      this.matchStep(this.base + event.node, event);
    }
  }

  private startNode(event: RunEvent & { type: "node-started" }, sequence: number): void {
    const key = this.base + event.node;
    const parent = event.parent === 0 ? 0 : this.base + event.parent;
    const before = this.nodes.get(key);
    this.nodes.set(key, {
      key,
      parent,
      kind: event.kind,
      name: event.name,
      source: event.source,
      status: "running",
      runs: (before?.runs ?? 0) + 1,
      startedAt: event.time,
      endedAt: null,
      startEvent: sequence,
      endEvent: null,
      failure: null,
      failedCall: null,
      choice: null,
      values: [],
      children: before?.children ?? [],
    });
    if (before !== undefined) return;
    const around = this.nodes.get(parent);
    if (around === undefined) this.state.roots = [...this.state.roots, key];
    else this.nodes.set(parent, { ...around, children: [...around.children, key] });
  }

  /** A call that starts with another implementation, or again, gets another body. */
  private dropBody(key: number): void {
    for (const child of this.nodes.get(key)?.children ?? []) {
      this.dropBody(child);
      this.nodes.delete(child);
    }
    this.update(key, { children: [] });
  }

  private update(key: number, change: Partial<TreeNode>): void {
    const node = this.nodes.get(key);
    if (node !== undefined) this.nodes.set(key, { ...node, ...change });
  }

  private replaceAttempt(change: Partial<Attempt>): void {
    const last = this.attempts.at(-1);
    if (last !== undefined) this.attempts[this.attempts.length - 1] = { ...last, ...change };
  }

  /** Note which call is a step of the plan: the first step of its skill and arguments that has none yet. */
  private matchStep(key: number, event: ImplementationChosen): void {
    const last = this.attempts.at(-1);
    if (last?.plan == null || last.nodes.includes(key) || isInsideCall(this.nodes, key)) return;
    const at = last.plan.steps.findIndex((step, index) => last.nodes[index] === null && matches(step, event));
    if (at >= 0) this.replaceAttempt({ nodes: last.nodes.map((each, index) => (index === at ? key : each)) });
  }
}

function matches(step: PlanStep, event: ImplementationChosen): boolean {
  const same = ([name, value]: [string, unknown]): boolean =>
    JSON.stringify(event.bindings[name]) === JSON.stringify(value);
  return step.skill === event.skill && Object.entries(step.arguments).every(same);
}

/** Yield the nodes around a node, the innermost first. */
export function* ancestors(nodes: ReadonlyMap<number, TreeNode>, key: number): Generator<TreeNode> {
  let node = nodes.get(nodes.get(key)?.parent ?? 0);
  while (node !== undefined) {
    yield node;
    node = nodes.get(node.parent);
  }
}

function isInsideCall(nodes: ReadonlyMap<number, TreeNode>, key: number): boolean {
  for (const each of ancestors(nodes, key)) if (each.kind === "call") return true;
  return false;
}

/** Return the running calls that no other running call is in, with their paths from the root. */
export function activeCalls(state: OperationState): TreeNode[] {
  const running = [...state.nodes.values()].filter(
    (each) => each.kind === "call" && each.status === "running",
  );
  const outer = new Set(
    running.flatMap((each) => [...ancestors(state.nodes, each.key)].map((node) => node.key)),
  );
  return running.filter((each) => !outer.has(each.key));
}
