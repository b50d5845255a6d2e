// Trials: one series is shown with its distributions, and a trial that is run again to be seen.
import { signal } from "@preact/signals";
import { api, ApiError } from "../api/client";
import type { Series, Spread } from "../api/types";
import { attempt } from "./actions";
import { jobsOf, RECORDING, runJob, type JobOf } from "./jobs";
import { replayJob } from "./replay";
import { message } from "./studio";

export type Trials = JobOf<"trials">;

/** The series that is shown; `result` is null while it is read. */
export const shownSeries = signal<{ about: Trials; result: Series | null } | null>(null);
/** The trial that is run again now. */
export const replayed = signal<{ readonly trials: string; readonly seed: number } | null>(null);

/** What can disturb each trial of a series, as people say it. */
export const DISTURBANCES = {
  none: "nothing",
  missing: "surfaces, fixtures and persons are missing",
  obstacle: "an obstacle is in the way",
  push: "a person pushes the arm",
  take: "a person takes what a hand holds",
} as const;

/** Return what disturbs the trials of a series; nothing if nothing does. */
export function describeDisturbance({ request: { disturb = "none" } }: Trials): string {
  return disturb === "none" ? "" : DISTURBANCES[disturb];
}

/** Show a series with the distributions of what was measured. */
export async function showSeries(about: Trials): Promise<void> {
  const before = shownSeries.peek();
  shownSeries.value = { about, result: before?.about.id === about.id ? before.result : null };
  const done = await attempt(async () => {
    const { outcome } = await api.jobResult(about.id);
    if (outcome.kind !== "trials") throw new ApiError(0, "These are no trials.");
    const result = outcome.series as Series;
    if (shownSeries.peek()?.about.id === about.id) shownSeries.value = { about, result };
  });
  if (!done) shownSeries.value = before;
}

/** Show more of the series that is shown, as soon as more trials are done. */
export function followSeries(): void {
  const shown = shownSeries.peek()?.about;
  const now = shown && jobsOf("trials").find((each) => each.id === shown.id);
  if (now !== undefined && (now.done !== shown?.done || now.state !== shown.state)) void showSeries(now);
}

/** Run a trial again, unless that was done before, and play it in all panels. */
export async function playTrial(about: Trials, seed: number): Promise<void> {
  const own = { trials: about.id, seed };
  replayed.value = own;
  const done = await attempt(async () => {
    const before = jobsOf("trial-replay").find(
      ({ request, files }) =>
        request.trials === about.id && request.seed === seed && files.includes(RECORDING),
    );
    const job = before ?? (await runJob({ kind: "trial-replay", ...own }));
    if (replayed.peek() !== own) return;
    await replayJob(job, `${about.request.task}, seed ${seed}`);
    shownSeries.value = null;
  });
  if (replayed.peek() !== own) return;
  if (done) message.value = null;
  replayed.value = null;
}

/** Remove a series; what it has measured is lost, so a person is asked before. */
export async function removeSeries(about: Trials): Promise<void> {
  await attempt(async () => {
    await api.removeJob(about.id);
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
  const value = spread.sense === "at-least" ? spread.least : spread.greatest;
  const seed = spread.seeds[spread.values.indexOf(value)];
  return seed === undefined ? null : { seed, value };
}
