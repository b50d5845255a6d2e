// Links in the lines of an explanation.
import { expect, test } from "vitest";
import { linkLine } from "../src/state/linking";

const THINGS = new Set(["lab:Panda-1", "lab:Hand-1"]);

test("places and individuals are links, and the text stays as it is", () => {
  const line = "    `arm hasA gripper` (std/handling.skill:20): lab:Panda-1 hasA lab:Hand-1, not lab:Other";
  const parts = linkLine(line, THINGS, new Set());
  expect(parts.map((each) => each.text).join("")).toBe(line);
  expect(parts.filter((each) => each.kind !== "text")).toEqual([
    {
      kind: "place",
      text: "std/handling.skill:20",
      place: { path: "std/handling.skill", line: 20, column: 1 },
    },
    { kind: "thing", text: "lab:Panda-1" },
    { kind: "thing", text: "lab:Hand-1" },
  ]);
});

test("a number is a call only at the beginning of a line, and if there is one", () => {
  const calls = new Set(["2", "2.1"]);
  expect(linkLine("  2.1  Pick[from_above]  2 s", THINGS, calls).map((each) => each.kind)).toEqual([
    "text",
    "call",
    "text",
  ]);
  expect(linkLine("  7  Pick", THINGS, calls)).toEqual([{ kind: "text", text: "  7  Pick" }]);
  expect(linkLine("<b>x</b>", THINGS, calls)).toEqual([{ kind: "text", text: "<b>x</b>" }]);
});
