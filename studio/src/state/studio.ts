// What the page knows: signals that views read. Only `live.ts`, `replay.ts` and `actions.ts` write them.
import { computed, signal } from "@preact/signals";
import type { StreamStatus } from "../api/stream";
import type {
  CellStatus,
  Failure,
  Lease,
  LibraryDescription,
  OperationStatus,
  OperationTree,
  PlanPreview,
  RunState,
  Sample,
  Session,
  WorldFact,
} from "../api/types";
import { EMPTY, type OperationState } from "./operation";
import { pendingNodes, withPlanned } from "./planned";
import { describeReason, describeRequest } from "./text";
import { NOTHING, selectedPlace, selectedSpan, selectedThings, type Selection } from "./selection";

/** Who is logged in: null for nobody, undefined while that is not known yet. */
export const session = signal<Session | null | undefined>(undefined);
export const connection = signal<StreamStatus>({ state: "connecting" });

export const cells = signal<ReadonlyMap<string, CellStatus>>(new Map());
export const operations = signal<ReadonlyMap<string, OperationStatus>>(new Map());
export const cellName = signal<string | null>(null);
export const cell = computed(() => cells.value.get(cellName.value ?? "") ?? null);

/** Whether the cell has stopped by itself, or was stopped, and waits until somebody acknowledges that. */
export const isCellStopped = computed(
  () => cell.value !== null && !["off", "operational"].includes(cell.value.state),
);

export const library = signal<LibraryDescription | null>(null);
export const facts = signal<readonly WorldFact[]>([]);
/** Whether the facts of the cell that is shown have been read. */
export const areFactsRead = signal(false);
/** The number of the last write that `facts` has. */
export const worldSequence = signal(0);

/** The operation that is shown, and what its events tell. */
export const operationId = signal<string | null>(null);
export const status = computed(() => operations.value.get(operationId.value ?? "") ?? null);
export const live = signal<OperationState>(EMPTY);

/** The plan for what is chosen and has not been started; null if nothing is, or it has no plan. */
export const preview = signal<PlanPreview | null>(null);

/** A recording that is played: what it tells at `time`, instead of what happens now. */
export interface Replay {
  name: string;
  state: OperationState;
  /** The tree of all plans; null if only the recording is known. */
  tree: OperationTree | null;
  sample: Sample | null;
  begin: number;
  end: number;
  time: number;
  playing: boolean;
  speed: number;
}
export const replay = signal<Replay | null>(null);

/** The tree that the server has made of the plans of the operation; null while it is not known. */
export const planned = signal<OperationTree | null>(null);
/** What the events tell that are shown: those that come, or those of the recording that is played. */
export const told = computed(() => replay.value?.state ?? live.value);
const shownPlans = computed(() => {
  const tree = replay.value === null ? planned.value : replay.value.tree;
  return tree && pendingNodes(tree);
});
export const operation = computed(() => withPlanned(told.value, shownPlans.value));

export const sample = signal<Sample | null>(null);
export const shownSample = computed(() => (replay.value === null ? sample.value : replay.value.sample));

export const selection = signal<Selection>(NOTHING);
export const span = computed(() => selectedSpan(selection.value, operation.value, shownTime.value));
export const place = computed(() => selectedPlace(selection.value, operation.value));
export const things = computed(() => selectedThings(selection.value, operation.value));

export interface Message {
  kind: "error" | "done";
  text: string;
  /** Takes back what was done. */
  undo?: () => void;
}
/** What became last of something that a person wanted, until it is dismissed. */
export const message = signal<Message | null>(null);

const RANKS = ["view", "operate", "edit", "admin"];

/** Whether who is logged in may do what needs a role. */
export function may(role: "operate" | "edit" | "admin"): boolean {
  const own = session.value?.role;
  return own !== undefined && RANKS.indexOf(own) >= RANKS.indexOf(role);
}

/** Who has the lease of the cell that is shown; null while that is not known. */
export const lease = signal<Lease | null>(null);

/** Return why who is logged in may not command the cell with a role, as a sentence; nothing if that is allowed. */
export function refusalOf(role: "operate" | "edit"): string {
  if (!may(role)) return `This needs the role ${role}; you have ${session.value?.role ?? "none"}.`;
  const owner = lease.value?.owner ?? null;
  if (owner === null || owner === session.value?.name) return "";
  return `${owner} has the lease of this cell; you may watch and stop.`;
}

/** Whether who is logged in may command the cell that is shown. */
export const mayCommand = (role: "operate" | "edit" = "operate"): boolean => refusalOf(role) === "";

/** Whether a command is possible now for the operation that is shown. */
export function allows(command: string): boolean {
  return replay.value === null && (status.value?.allowed.includes(command) ?? false);
}

export const ENDS: readonly string[] = ["succeeded", "failed", "stopped", "interrupted"];

/** Whether the operation that is shown goes on. */
export const isOngoing = computed(() => status.value !== null && !ENDS.includes(status.value.state));

/** The time of what is shown in s of the cell: the present while it goes on, else that of its last event. */
export const shownTime = computed(() => {
  const { task, time } = operation.value;
  const goesOn = replay.value === null && isOngoing.value && task !== null;
  return goesOn ? Math.max(time, sample.value?.time_s ?? 0) : time;
});

/** What goes on or waits in the cell that is shown, whoever started it. */
export const ongoing = computed(() =>
  [...operations.value.values()].filter((each) => each.cell === cellName.value && !ENDS.includes(each.state)),
);

/** Return which operation of the cell goes on although another one, which has ended, is shown; nothing if none does. */
export function describeUnseen(): string {
  const other = isOngoing.value && replay.value === null ? undefined : ongoing.value[0];
  return other === undefined
    ? ""
    : `${describeRequest(other.request)} goes on and is not shown; the strip on top leads to it.`;
}

/** The run that is shown, and how it is: as the server says, or as a recording tells at its time. */
export interface ShownRun {
  title: string;
  state: RunState | null;
  verified: boolean | null;
  claims: readonly string[];
  /** Whether its skills ask a person. */
  asks: boolean;
  reason: string;
  failure: Failure | null;
  goesOn: boolean;
}
export const shownRun = computed((): ShownRun | null => {
  if (replay.value !== null) {
    const { state, ended, reason, prompts } = told.value;
    const { verified = null, failure = null, false_claims: claims = [] } = ended ?? {};
    const asks = prompts.length > 0;
    return {
      title: replay.value.name,
      state,
      verified,
      claims,
      asks,
      failure,
      reason,
      goesOn: ended === null,
    };
  }
  if (status.value === null) return null;
  const { request, state, verified, false_claims: claims, failure } = status.value;
  return {
    title: describeRequest(request),
    state,
    verified,
    claims,
    asks: status.value.prompts.length > 0,
    reason: describeReason(status.value),
    failure,
    goesOn: isOngoing.value,
  };
});
