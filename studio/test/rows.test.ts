import { describe, expect, test } from "vitest";
import type { Envelope } from "../src/api/types";
import { applyEvents, EMPTY, type OperationState } from "../src/state/operation";
import { treeRows, visibleRange, type TreeOptions } from "../src/state/rows";

const OPTIONS: TreeOptions = { all: false, folds: new Map(), filter: "" };

/** A tree of `text`: a line a node, indented by two; `seq` is structure, a name with `!` fails, with `+` has ended. */
function tree(text: string): OperationState {
  const source = { path: "a.skill", line: 1, column: 1 };
  const events: Envelope["event"][] = [];
  const ends: Envelope["event"][] = [];
  const path: number[] = [0];
  text
    .trim()
    .split("\n")
    .forEach((line, index) => {
      const name = line.trim();
      const depth = (line.length - line.trimStart().length) / 2;
      path[depth + 1] = index + 1;
      const kind = name === "seq" ? "seq" : "call";
      events.push({
        type: "node-started",
        time: 0,
        node: index + 1,
        parent: path[depth] ?? 0,
        kind,
        name,
        source,
      });
      const status = name.includes("!") ? "failure" : name.includes("+") ? "success" : null;
      if (status !== null) ends.push({ type: "node-ended", time: 1, node: index + 1, name, status, source });
    });
  return applyEvents(
    EMPTY,
    [...events, ...ends].map((event, at) => ({ run: "r", sequence: at + 1, wall_time_ns: 0, event })),
  );
}

const shown = (state: OperationState, options: Partial<TreeOptions> = {}): string[] =>
  treeRows(state, { ...OPTIONS, ...options }).map((each) => "  ".repeat(each.depth) + each.node.name);

const EXAMPLE = tree(`
seq
  A+
    seq
      A1+
        A2+
  B
    B1
  C!
    C1!
`);

describe("rows", () => {
  test("leave structure out, and fold what has succeeded below the first level", () => {
    expect(shown(EXAMPLE)).toEqual(["A+", "  A1+", "B", "  B1", "C!", "  C1!"]);
  });
  test("show all nodes", () => {
    expect(shown(EXAMPLE, { all: true }).slice(0, 3)).toEqual(["seq", "  A+", "  B"]);
  });
  test("are as a person has folded them", () => {
    expect(
      shown(EXAMPLE, {
        folds: new Map([
          [2, false],
          [6, false],
        ]),
      }),
    ).toEqual(["A+", "B", "C!", "  C1!"]);
  });
  test("with a filter show what is found and all around it", () => {
    expect(shown(EXAMPLE, { filter: "a2" })).toEqual(["A+", "  A1+", "    A2+"]);
    expect(shown(EXAMPLE, { filter: "nothing" })).toEqual([]);
  });
});

describe("the visible range", () => {
  test.each([
    [0, 240, 3000, [0, 18]],
    [24_000, 240, 3000, [992, 1018]],
    [71_900, 240, 3000, [2987, 3000]],
    [0, 240, 3, [0, 3]],
  ])("of a list scrolled to %d with %d px of %d rows", (top, height, count, range) => {
    expect(visibleRange(top, height, 24, count)).toEqual(range);
  });
});
