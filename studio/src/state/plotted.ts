// What a plot shows: lines with their values over time; continued by a later plot, cut, and with gaps; pure functions.
import { GAP_S, type SignalLine } from "./series";

/** Lines and their columns, the time in s first. */
export interface Plotted {
  lines: readonly SignalLine[];
  columns: readonly (number | null)[][];
}

/**
 * Return a plot with the rows of another one that are later. A line that the first one does not have is known at its times
 * where the other one has values around them.
 */
export function continuePlot(first: Plotted, then: Plotted): Plotted {
  const before = first.columns[0] ?? [];
  const last = before.at(-1) ?? -Infinity;
  const times = then.columns[0] ?? [];
  const from = times.findIndex((each) => (each ?? 0) > last);
  const later = from < 0 ? [] : times.slice(from);
  const names = new Set(first.lines.map((each) => each.name));
  const lines = [...first.lines, ...then.lines.filter((each) => !names.has(each.name))];
  const column = (name: string): (number | null)[] => {
    const [own, seen] = [columnOf(first, name), columnOf(then, name)];
    return [
      ...(own ?? valuesAt(before, times, seen ?? [])),
      ...(seen === undefined ? later.map(() => null) : seen.slice(times.length - later.length)),
    ];
  };
  return { lines, columns: [[...before, ...later], ...lines.map(({ name }) => column(name))] };
}

/** Return a plot without the lines that are known at no time: such as the force of pushes where nothing is pushed. */
export function dropEmpty({ lines, columns }: Plotted): Plotted {
  const isKnown = lines.map((_, at) => columns[at + 1]?.some((each) => each !== null) ?? false);
  if (isKnown.every(Boolean)) return { lines, columns };
  return {
    lines: lines.filter((_, at) => isKnown[at]),
    columns: columns.filter((_, at) => at === 0 || isKnown[at - 1]),
  };
}

type Column = readonly (number | null)[];

function columnOf({ lines, columns }: Plotted, name: string): Column | undefined {
  const at = lines.findIndex((each) => each.name === name);
  return at < 0 ? undefined : columns[at + 1];
}

/** Return values at other times, which are in order: on the line between those around; null where one of them is not known. */
function valuesAt(wanted: Column, times: Column, values: Column): (number | null)[] {
  let next = 0;
  return wanted.map((time) => {
    if (time === null) return null;
    while ((times[next] ?? Infinity) < time) next++;
    const [from, to] = [times[next - 1], times[next]];
    const [one, other] = [values[next - 1], values[next]];
    if (to === time) return other ?? null;
    if (from == null || to == null || one == null || other == null) return null;
    return one + ((other - one) * (time - from)) / (to - from);
  });
}

/** Return the rows of columns whose times are in a span; none if there are none there. */
export function between(columns: (number | null)[][], from: number, to: number): (number | null)[][] {
  const times = columns[0] ?? [];
  const first = times.findIndex((each) => (each ?? 0) >= from);
  const end = times.findLastIndex((each) => (each ?? 0) <= to);
  return columns.map((each) => (first < 0 || end < first ? [] : each.slice(first, end + 1)));
}

/** Whether a page has missed something after a time: columns have a gap, or begin later. */
export function hasGaps(columns: readonly (readonly (number | null)[])[], since: number): boolean {
  const [times = [], ...values] = columns;
  const first = times.findIndex((each) => (each ?? 0) >= since);
  if (first < 0 || (times[first] ?? 0) - since > GAP_S) return true;
  return times.some((_, row) => row >= first && values.every((each) => each[row] === null));
}
