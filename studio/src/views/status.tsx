// States of cells, operations and nodes: each has a colour, a shape and a word.
import type { CellState, ControlReport, RunState } from "../api/types";
import type { NodeStatus } from "../state/operation";
import { ENDS } from "../state/studio";
import { Icon, type IconName } from "./icons";

type Look = [tone: string, icon: IconName, word: string];

const RUN: Record<RunState, Look> = {
  queued: ["is-waiting", "hourglass", "queued"],
  planning: ["is-running", "hourglass", "planning"],
  planned: ["is-waiting", "ring", "waits for approval"],
  running: ["is-running", "play", "running"],
  pausing: ["is-waiting", "pause", "pausing"],
  paused: ["is-waiting", "pause", "paused"],
  stopping: ["is-bad", "stop", "stopping"],
  succeeded: ["is-good", "check", "succeeded"],
  failed: ["is-bad", "cross", "failed"],
  stopped: ["is-idle", "stop", "stopped"],
  interrupted: ["is-bad", "warning", "interrupted"],
};
const CELL: Record<CellState, Look> = {
  off: ["is-idle", "ring", "off"],
  operational: ["is-good", "check", "operational"],
  "protective-stop": ["is-bad", "warning", "protective stop"],
  fault: ["is-bad", "cross", "fault"],
  "emergency-stop": ["is-bad", "stop", "emergency stop"],
};
const CONTROL: Record<ControlReport["state"], Look> = {
  ready: ["is-idle", "ring", "not controlled"],
  "in-control": ["is-good", "check", "in control"],
  "not-in-control": ["is-waiting", "locked", "somebody else has control"],
  "wrong-mode": ["is-waiting", "warning", "takes no commands"],
  "protective-stop": ["is-bad", "warning", "protective stop"],
  "emergency-stop": ["is-bad", "stop", "emergency stop"],
  lost: ["is-bad", "plug", "does not answer"],
};
const NODE: Record<NodeStatus, Look> = {
  pending: ["is-idle", "ring", "not started"],
  running: ["is-running", "play", "running"],
  success: ["is-good", "check", "done"],
  failure: ["is-bad", "cross", "failed"],
  halted: ["is-idle", "halted", "halted"],
};

function Badge({ look, word }: { look: Look; word?: string }) {
  const [tone, icon, own] = look;
  return (
    <span class={`badge ${tone}`}>
      <Icon name={icon} />
      {word ?? own}
    </span>
  );
}

interface RunBadgeProps {
  state: RunState;
  /** Whether its skills ask a person. */
  asks?: boolean;
  /** Whether this is how it is now; otherwise it was so when the connection was lost. */
  isKnown?: boolean;
  verified?: boolean | null | undefined;
  claims?: readonly string[] | undefined;
}

/** The state of an operation; a success that rests on assumed facts, or whose claims are false, is not called one. */
export function RunBadge({ state, asks = false, isKnown = true, verified, claims = [] }: RunBadgeProps) {
  if (!isKnown && !ENDS.includes(state)) return <Badge look={["is-idle", "ring", `was ${RUN[state][2]}`]} />;
  if (asks) return <Badge look={["is-waiting", "help", "asks"]} />;
  if (state === "succeeded" && claims.length > 0)
    return <Badge look={["is-bad", "cross", "false success"]} />;
  if (state === "succeeded" && verified === false)
    return <Badge look={["is-waiting", "check", "finished, not verified"]} />;
  return <Badge look={RUN[state]} />;
}

/** How a notice looks that says why an operation has ended: what a person has stopped has not failed. */
export function toneOfEnd(state: RunState | null): "bad" | "" {
  return state === "stopped" ? "" : "bad";
}

/** What the world model claims that is not so in the simulator. */
export function FalseClaims({ claims }: { claims: readonly string[] | undefined }) {
  return (
    <>
      {(claims ?? []).map((each) => (
        <p key={each} class="notice bad">
          Contradicted by the simulator: {each}
        </p>
      ))}
    </>
  );
}

/** The state of a cell, or the one that it had last while there is no connection. */
export function CellBadge({ state, isKnown }: { state: CellState; isKnown: boolean }) {
  const [, , word] = CELL[state];
  return <Badge look={isKnown ? CELL[state] : ["is-idle", "ring", `was ${word}`]} />;
}

/** Return how the state of a real arm looks, or the one that it had last while there is no connection. */
export function lookOfControl(state: ControlReport["state"], isKnown: boolean): Look {
  return isKnown ? CONTROL[state] : ["is-idle", "ring", `was: ${CONTROL[state][2]}`];
}

/** The state of a node as a shape; its word is for screen readers. */
export function NodeMark({ status }: { status: NodeStatus }) {
  const [tone, icon, word] = NODE[status];
  return (
    <span class={`node-mark ${tone}`} title={word}>
      <Icon name={icon} />
      <span class="visually-hidden">{word}</span>
    </span>
  );
}

export function nodeWord(status: NodeStatus): string {
  return NODE[status][2];
}
