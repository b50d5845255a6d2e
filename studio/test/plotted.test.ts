import { expect, test } from "vitest";
import { continuePlot } from "../src/state/plotted";
import { makeLine } from "../src/state/series";

const FORCE = makeLine("force", "Arm");
const SPEED = makeLine("speed", "Arm");

test("the recording comes before what was seen, and fills its gaps", () => {
  const stored = {
    lines: [SPEED, FORCE],
    columns: [
      [0, 1, 2],
      [1, 1, 1],
      [5, 6, 7],
    ],
  };
  const seen = {
    lines: [FORCE],
    columns: [
      [0, 1.5, 2, 3],
      [5, null, 7, 8],
    ],
  };
  expect(continuePlot(stored, seen)).toEqual({
    lines: [SPEED, FORCE],
    columns: [
      [0, 1, 2, 3],
      [1, 1, 1, null],
      [5, 6, 7, 8],
    ],
  });
  expect(continuePlot(stored, { lines: [FORCE], columns: [[0], [5]] })).toEqual(stored);
});

test("what only the page has seen stays in sight beside the recording, and what it missed a gap", () => {
  const stored = {
    lines: [FORCE],
    columns: [
      [0, 1, 2, 3, 4, 5],
      [5, 6, 7, 8, 9, 9],
    ],
  };
  const seen = {
    lines: [SPEED],
    columns: [
      [1, 1.5, 2.5, 4, 5, 6],
      [10, 20, 40, null, 50, 60],
    ],
  };
  expect(continuePlot(stored, seen)).toEqual({
    lines: [FORCE, SPEED],
    columns: [
      [0, 1, 2, 3, 4, 5, 6],
      [5, 6, 7, 8, 9, 9, null],
      [null, 10, 30, null, null, 50, 60],
    ],
  });
});
