// Plays a recording: the same state as live, made of the events up to a time.
import { batch, signal } from "@preact/signals";
import { api, ApiError } from "../api/client";
import type { Envelope, Job, OperationTree } from "../api/types";
import { Film, lastUpTo } from "../recording/film";
import { readRecording } from "../recording/recording";
import { RECORDING } from "./jobs";
import { applyEvents, EMPTY, type OperationState } from "./operation";
import { recorded } from "./signals";
import * as studio from "./studio";
import type { Replay } from "./studio";

let events: TimedEvents = timeEvents([]);
let film = new Film();
let timer = 0;
const TICK_MS = 50;

/** The rehearsal that was played last, and the operation that was shown before it. */
export const rehearsed = signal<{ film: Film; operation: string | null } | null>(null);

/** Read the recording of an operation from the server, and play it. */
export async function replayOperation(id: string): Promise<void> {
  const tree = api.tree(id).catch((error: unknown) => {
    if (!(error instanceof ApiError)) throw error;
    return null;
  });
  openRecording(id, await api.recording(id), await tree);
}

/** Read the recording that a job has left, and play it from its beginning; what was rehearsed is planned. */
export async function replayJob({ id, request }: Job, name: string): Promise<void> {
  openRecording(name, await api.jobFile(id, RECORDING));
  if (request.kind === "rehearsal") rehearsed.value = { film, operation: studio.operationId.peek() };
  play(true);
}

/** Play a file; ApiError if it is no recording. */
export function openRecording(name: string, content: ArrayBuffer, tree: OperationTree | null = null): void {
  const found = read(content);
  events = timeEvents(found.envelopes);
  film = found.film;
  const [begin, end] = [events.times[0] ?? 0, events.times.at(-1) ?? 0];
  batch(() => {
    recorded.value = { lines: found.lines, columns: found.columns };
    studio.selection.value = { kind: "nothing" };
    studio.replay.value = {
      name,
      state: EMPTY,
      tree,
      sample: null,
      begin,
      end,
      time: begin,
      playing: false,
      speed: 4,
    };
  });
  seek(end);
}

function read(content: ArrayBuffer): ReturnType<typeof readRecording> {
  try {
    return readRecording(content);
  } catch (error) {
    throw new ApiError(
      0,
      `This recording cannot be read: ${error instanceof Error ? error.message : String(error)}`,
    );
  }
}

/** Events in their order, and when each has happened and all before it: times in s of the cell that never fall. */
export interface TimedEvents {
  envelopes: readonly Envelope[];
  times: readonly number[];
}

export function timeEvents(envelopes: readonly Envelope[]): TimedEvents {
  let latest = -Infinity;
  return { envelopes, times: envelopes.map(({ event }) => (latest = Math.max(latest, event.time))) };
}

/** Times that differ by less are the same: a slider rounds them. */
const SAME_S = 1e-6;

/** Return the state at a time: that of before with more events, or from the beginning again. */
export function stateAt(
  { envelopes, times }: TimedEvents,
  time: number,
  before: OperationState = EMPTY,
): OperationState {
  const until = envelopes.slice(0, lastUpTo(times, time + SAME_S) + 1);
  const isLater = (until.at(-1)?.sequence ?? 0) >= before.lastEvent;
  return { ...applyEvents(isLater ? before : EMPTY, until), time };
}

export function seek(time: number): void {
  const current = studio.replay.peek();
  if (current === null) return;
  const at = Math.min(current.end, Math.max(current.begin, time));
  show({ ...current, time: at });
}

/** Show a recording as it was at its time. */
function show(replay: Replay): void {
  const state = stateAt(events, replay.time, replay.state);
  studio.replay.value = { ...replay, state, sample: film.sampleAt(replay.time) };
}

export function play(playing: boolean): void {
  const current = studio.replay.peek();
  window.clearInterval(timer);
  if (current === null) return;
  const time = playing && current.time >= current.end ? current.begin : current.time;
  show({ ...current, time, playing });
  if (!playing) return;
  let last = performance.now();
  timer = window.setInterval(() => {
    const now = performance.now();
    const running = studio.replay.peek();
    if (running === null) return window.clearInterval(timer);
    seek(running.time + ((now - last) / 1000) * running.speed);
    last = now;
    if ((studio.replay.peek()?.time ?? 0) >= running.end) play(false);
  }, TICK_MS);
}

export function setSpeed(speed: number): void {
  const current = studio.replay.peek();
  if (current !== null) studio.replay.value = { ...current, speed };
}

/** Show again what happens now. */
export function endReplay(): void {
  window.clearInterval(timer);
  events = timeEvents([]);
  film = new Film();
  batch(() => {
    studio.replay.value = null;
    recorded.value = null;
    studio.selection.value = { kind: "nothing" };
  });
}
