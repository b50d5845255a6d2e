// Series of trials: those of the cell, one that is shown with its distributions, and a trial that is run again to be seen.
import { signal } from "@preact/signals";
import { api, ApiError } from "../api/client";
import type { Series, Spread, TrialSeries } from "../api/types";
import { attempt } from "./actions";
import { replayTrial } from "./replay";
import { cellName, message } from "./studio";

export const allSeries = signal<readonly TrialSeries[] | null>(null);
/** The series that is shown; `result` is null while it is read. */
export const shownSeries = signal<{ about: TrialSeries; result: Series | null } | null>(null);
/** The trial that is run again now. */
export const replayed = signal<{ readonly series: string; readonly seed: number } | null>(null);

const LOOK_MS = 1000;

/** What can disturb each trial of a series, as people say it. */
export const DISTURBANCES = {
  none: "nothing",
  missing: "surfaces, fixtures and persons are missing",
  obstacle: "an obstacle is in the way",
  push: "a person pushes the arm",
  take: "a person takes what a hand holds",
} as const;
const TRIALS = 50;

/** Return how many trials a series has when it is done. */
export const wantedTrials = ({ request }: TrialSeries): number => request.number ?? TRIALS;

/** Return what disturbs the trials of a series; nothing if nothing does. */
export function describeDisturbance({ request: { disturb = "none" } }: TrialSeries): string {
  return disturb === "none" ? "" : DISTURBANCES[disturb];
}

export const goesOn = (series: TrialSeries): boolean =>
  series.state === "waiting" || series.state === "going on";

/** Read the series of a cell, again while one goes on; the function that is returned ends that. */
export function followSeries(cell: string): () => void {
  let timer = 0;
  let isOver = false;
  const look = async (): Promise<void> => {
    try {
      const found = await api.trials(cell);
      if (isOver) return;
      allSeries.value = found.reverse();
      const about = found.find((each) => each.id === shownSeries.peek()?.about.id);
      if (about !== undefined && about.done !== shownSeries.peek()?.about.done) await showSeries(about);
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
    }
    if (!isOver) timer = window.setTimeout(() => void look(), LOOK_MS);
  };
  void look();
  return () => {
    isOver = true;
    window.clearTimeout(timer);
  };
}

/** Show a series with the distributions of what was measured. */
export async function showSeries(about: TrialSeries): Promise<void> {
  const before = shownSeries.peek();
  shownSeries.value = { about, result: before?.about.id === about.id ? before.result : null };
  const done = await attempt(async () => {
    const result = await api.trialsResult(about.id);
    if (shownSeries.peek()?.about.id === about.id) shownSeries.value = { about, result };
  });
  if (!done) shownSeries.value = before;
}

/** Run a trial again, and play it in all panels. */
export async function playTrial(about: TrialSeries, seed: number): Promise<void> {
  const own = { series: about.id, seed };
  replayed.value = own;
  const done = await attempt(async () => {
    let found = await api.replayTrial(about.id, seed);
    while (found.state === "going on") {
      await new Promise((resolve) => window.setTimeout(resolve, LOOK_MS / 2));
      if (replayed.peek() !== own) return;
      found = await api.trialReplay(about.id, seed);
    }
    if (!found.recording) throw new ApiError(0, `Trial ${seed} was not recorded: ${found.reason}`);
    await replayTrial(about.id, seed, about.request.task);
    shownSeries.value = null;
  });
  if (replayed.peek() !== own) return;
  if (done) message.value = null;
  replayed.value = null;
}

/** Remove a series; what it has measured is lost, so a person is asked before. */
export async function removeSeries(about: TrialSeries): Promise<void> {
  await attempt(async () => {
    await api.removeTrials(about.id);
    allSeries.value = (allSeries.peek() ?? []).filter((each) => each.id !== about.id);
    if (shownSeries.peek()?.about.id === about.id) shownSeries.value = null;
  });
}

export interface Dot {
  seed: number;
  value: number;
  /** Where it is between the least and the greatest value that is drawn, 0 to 1. */
  at: number;
  /** How many dots lie below it at the same place. */
  level: number;
}

/** How many places next to each other the dots of a plot can have. */
const PLACES = 60;

/** Return the dots of a distribution, those at the same place above each other, and where its bound is. */
export function dotsOf(spread: Spread): { dots: Dot[]; bound: number | null; low: number; high: number } {
  const low = Math.min(spread.least, spread.bound ?? spread.least);
  const high = Math.max(spread.greatest, spread.bound ?? spread.greatest);
  const range = high - low;
  const place = (value: number): number => (range === 0 ? 0.5 : (value - low) / range);
  const levels = new Map<number, number>();
  const dots = spread.values.map((value, index) => {
    const at = Math.round(place(value) * PLACES) / PLACES;
    const level = levels.get(at) ?? 0;
    levels.set(at, level + 1);
    return { seed: spread.seeds[index] ?? 0, value, at, level };
  });
  return { dots, bound: spread.bound === null ? null : place(spread.bound), low, high };
}

/** Return the trial that is the worst of a distribution. */
export function worstOf(spread: Spread): { seed: number; value: number } | null {
  const value = spread.sense === "at least" ? spread.least : spread.greatest;
  const seed = spread.seeds[spread.values.indexOf(value)];
  return seed === undefined ? null : { seed, value };
}

/** Begin a series in the cell that is shown, and list it. */
export async function beginSeries(request: Parameters<typeof api.beginTrials>[1]): Promise<boolean> {
  const cell = cellName.peek();
  if (cell === null) return false;
  return attempt(async () => {
    const begun = await api.beginTrials(cell, request);
    allSeries.value = [begun, ...(allSeries.peek() ?? [])];
  });
}
