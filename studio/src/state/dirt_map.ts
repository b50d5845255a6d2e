// Maps of dirt, as the world model has them: `60x80 4700c 100d9` are columns, rows, then cells, row after row.
import type { LabelledFact } from "../api/types";

const DIRT_MAP = "https://w3id.org/skillc/wiping#dirtMap";

export type DirtState = "clean" | "dirty" | "unseen" | "spared";

const STATES: Readonly<Record<string, DirtState>> = { c: "clean", d: "dirty", u: "unseen", s: "spared" };

/** Neighbouring cells of a row in the same state; `sure` is the probability that it is right. */
export interface DirtRun {
  column: number;
  row: number;
  length: number;
  state: DirtState;
  sure: number;
}

/** Rows go up along y of the surface, columns along x. */
export interface DirtMap {
  columns: number;
  rows: number;
  runs: readonly DirtRun[];
}

/** Return the map that a fact states; null for other facts, and for a text that is no map. */
export function statedDirtMap(fact: LabelledFact): DirtMap | null {
  if (fact.type !== "property" || fact.property.iri !== DIRT_MAP || typeof fact.value !== "string")
    return null;
  return parseDirtMap(fact.value);
}

/** Return the map of a text; null if it is none. */
export function parseDirtMap(text: string): DirtMap | null {
  const head = /^([1-9]\d*)x([1-9]\d*) /.exec(text);
  if (head === null) return null;
  const [columns, rows] = [Number(head[1]), Number(head[2])];
  const runs: DirtRun[] = [];
  let cell = 0;
  for (const word of text.slice(head[0].length).split(" ")) {
    const found = /^(\d+)([ucds])(\d?)$/.exec(word);
    const state = STATES[found?.[2] ?? ""];
    if (found === null || state === undefined) return null;
    const end = cell + Number(found[1]);
    if (end > columns * rows) return null;
    const sure = state === "unseen" ? 0 : found[3] === "" ? 1 : Number(found[3]) / 10;
    while (cell < end) {
      const column = cell % columns;
      const length = Math.min(end - cell, columns - column);
      runs.push({ column, row: Math.floor(cell / columns), length, state, sure });
      cell += length;
    }
  }
  return cell === columns * rows ? { columns, rows, runs } : null;
}

/** Return the share of each state of all cells that count: those that are to be worked on. */
export function dirtShare(map: DirtMap, state: DirtState): number {
  const count = (wanted: (each: DirtRun) => boolean): number =>
    map.runs.reduce((sum, each) => sum + (wanted(each) ? each.length : 0), 0);
  const counted = count((each) => each.state !== "spared");
  return counted === 0 ? 0 : count((each) => each.state === state) / counted;
}

/** Return what a map shows, in words. */
export function describeDirt(map: DirtMap): string {
  const percent = (state: DirtState): string => `${(100 * dirtShare(map, state)).toFixed(1)}% ${state}`;
  const parts = [percent("clean"), percent("dirty")];
  if (dirtShare(map, "unseen") > 0) parts.push(percent("unseen").replace("unseen", "not seen"));
  return parts.join(", ");
}
