// A text is changed into another one where they differ, so that what is around that keeps its place.
import { expect, test } from "vitest";
import { changeTo } from "../src/editor/edits";

test.each([
  ["same", "same", null],
  ["", "new", { from: 0, to: 0, insert: "new" }],
  ["old", "", { from: 0, to: 3, insert: "" }],
  ["one two three", "one 2 three", { from: 4, to: 7, insert: "2" }],
  ["aa", "aaa", { from: 2, to: 2, insert: "a" }],
  ["aaa", "aa", { from: 2, to: 3, insert: "" }],
])("%j becomes %j", (before, after, wanted) => {
  const change = changeTo(before, after);
  expect(change).toEqual(wanted);
  if (change !== null)
    expect(before.slice(0, change.from) + change.insert + before.slice(change.to)).toBe(after);
});
