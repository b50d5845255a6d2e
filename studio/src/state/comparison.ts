// Two runs side by side: the differences that `skillc diff` finds, both event histories, and both signals in one plot.
import { signal } from "@preact/signals";
import { api } from "../api/client";
import type { OperationStatus, RunDiff } from "../api/types";
import { attempt } from "./actions";
import { numberCalls, pairCalls, type CallPair } from "./calls";
import { applyEvents, EMPTY, type OperationState } from "./operation";
import type { Plotted } from "./plotted";
import { readSignals } from "./signals";

export interface ComparedRun {
  run: OperationStatus;
  state: OperationState;
  plotted: Plotted | null;
}

/** What is compared; `found` is null while it is read. */
export interface Comparison {
  first: OperationStatus;
  second: OperationStatus;
  found: { diff: RunDiff; first: ComparedRun; second: ComparedRun; pairs: readonly CallPair[] } | null;
}

export const comparison = signal<Comparison | null>(null);

/** Compare two runs, and show that instead of the panels. */
export async function compareRuns(first: OperationStatus, second: OperationStatus): Promise<void> {
  const begun: Comparison = { first, second, found: null };
  comparison.value = begun;
  const done = await attempt(async () => {
    const [diff, one, other] = await Promise.all([
      api.diff(first.id, second.id),
      readRun(first),
      readRun(second),
    ]);
    const pairs = pairCalls(numberCalls(one.state), numberCalls(other.state));
    if (comparison.peek() === begun)
      comparison.value = { ...begun, found: { diff, first: one, second: other, pairs } };
  });
  if (!done && comparison.peek() === begun) comparison.value = null;
}

const PAGE = 1000;

async function readRun(run: OperationStatus): Promise<ComparedRun> {
  let state = EMPTY;
  for (let count = PAGE; count === PAGE;) {
    const page = await api.events(run.id, state.lastEvent);
    state = applyEvents(state, page);
    count = page.length;
  }
  return { run, state, plotted: await readSignals(run.id) };
}

export type Part = RunDiff["differences"][number]["part"];
export const PARTS: readonly Part[] = [
  "settings",
  "requests",
  "plan",
  "choices",
  "outcomes",
  "measures",
  "times",
  "signals",
];

/** Return what differs in each call, by the number of the call. */
export function differencesOfCalls(diff: RunDiff): Map<string, RunDiff["differences"]> {
  const found = new Map<string, RunDiff["differences"]>();
  for (const each of diff.differences) {
    const number = /^\d+(?:\.\d+)*(?= )/.exec(each.what)?.[0];
    if (number === undefined || each.part === "plan") continue;
    found.set(number, [...(found.get(number) ?? []), each]);
  }
  return found;
}

/** Return the lines of one name that two runs have, over the time of both; null if only one has it. */
export function overlay(name: string, first: Plotted, second: Plotted): (number | null)[][] | null {
  const [at, other] = [first, second].map((each) => each.lines.findIndex((line) => line.name === name));
  if (at === undefined || other === undefined || at < 0 || other < 0) return null;
  const rows = new Map<number, [number | null, number | null]>();
  const add = (plotted: Plotted, column: number, side: 0 | 1): void => {
    const [times = [], values = []] = [plotted.columns[0], plotted.columns[column + 1]];
    const begin = times[0] ?? 0;
    times.forEach((time, index) => {
      const since = Math.round(((time ?? 0) - begin) * 1e4) / 1e4;
      const row = rows.get(since) ?? [null, null];
      row[side] = values[index] ?? null;
      rows.set(since, row);
    });
  };
  add(first, at, 0);
  add(second, other, 1);
  const times = [...rows.keys()].sort((one, later) => one - later);
  return [
    times,
    times.map((time) => rows.get(time)?.[0] ?? null),
    times.map((time) => rows.get(time)?.[1] ?? null),
  ];
}
