import { expect, test } from "vitest";
import { byDevice, colourLines, makeLine, measure, Series, shortNames } from "../src/state/series";
import { drawSvg, writeCsv } from "../src/state/signal_files";
import { dropEmpty, hasGaps } from "../src/state/plotted";
import type { ArmSample, Sample } from "../src/api/types";

const FORCE = makeLine("force", "Arm");
const SPEED = makeLine("speed", "Arm");

test("a series keeps the newest rows, in order, without repeated times", () => {
  const series = new Series([FORCE], 3);
  for (const time of [0.1, 0.2, 0.2, 0.3, 0.4, 0.5]) series.add(time, time === 0.4 ? [] : [time * 10]);
  expect(series.length).toBe(3);
  expect(series.columns()).toEqual([
    [0.3, 0.4, 0.5],
    [3, null, 5],
  ]);
});

test("what a page missed is a gap, never a line", () => {
  const series = new Series([FORCE], 10);
  for (const time of [0, 0.1, 5, 5.1]) series.add(time, [time]);
  const columns = series.columns();
  expect(columns[1]).toEqual([0, 0.1, null, 5, 5.1]);
  expect(hasGaps(columns, 0)).toBe(true);
  expect(hasGaps(columns, 5)).toBe(false);
  expect(hasGaps(columns, 20)).toBe(true);
});

const at = (time_s: number, x: number, more: Partial<ArmSample> = {}): Sample => ({
  cell: "c",
  time_s,
  things: {},
  arms: {
    "lab#a": {
      joints: [],
      speeds: [],
      base: [0, 0, 0, 1, 0, 0, 0],
      tool: [x, 0, 0, 1, 0, 0, 0],
      wrench: [3, 4, 0, 9, 9, 9],
      velocity: [0, 0.1, 0],
      commanded: [0.12, 0, 0],
      ...more,
    },
  },
});
const values = (sample: Sample): unknown[] => measure(sample).map(([{ name }, value]) => [name, value]);

test("the speed of a tool is not that of a reference that changes", () => {
  const expected = [
    ["force at a", 5],
    ["speed of a", 0.1],
    ["commanded speed of a", 0.12],
  ];
  expect(values(at(1, 0))).toEqual(expected);
  expect(values(at(1.02, 0.2))).toEqual(expected);
});

test("what a push asks for and the force on a tool stand beside what the wrist measures, while there are any", () => {
  const pushed: Sample = {
    ...at(1, 0, { wrench: null, commanded_force: [0, 0, 18] }),
    forces: { "lab#Eraser": { force: [0, 0, 17], point: [0, 0, 0] } },
  };
  expect(values(pushed).slice(0, 2)).toEqual([
    ["commanded force at a", 18],
    ["speed of a", 0.1],
  ]);
  expect(values(pushed).at(-1)).toEqual(["contact of Eraser", 17]);
});

test("a line that comes later was not known before, and one that is never known is not shown", () => {
  const series = new Series([FORCE], 3);
  for (const time of [1, 1.2, 1.4]) series.add(time, [time * 10]);
  const grown = series.withLines([FORCE, makeLine("commanded force", "Arm"), SPEED]);
  grown.add(1.6, [16, 8]);
  const columns = [
    [1.2, 1.4, 1.6],
    [12, 14, 16],
    [null, null, 8],
    [null, null, null],
  ];
  expect(grown.columns()).toEqual(columns);
  const shown = dropEmpty({ lines: grown.lines, columns });
  expect(shown.lines.map((each) => each.name)).toEqual(["force at Arm", "commanded force at Arm"]);
  expect(shown.columns).toEqual(columns.slice(0, 3));
});

test("lines stand by device, which is named once, and what is commanded has the colour of what is measured", () => {
  const lines = [
    makeLine("commanded speed", "Arm"),
    makeLine("contact", "Eraser"),
    makeLine("force", "Arm"),
    makeLine("speed", "Arm"),
    makeLine("commanded force", "Arm"),
  ];
  const order = byDevice(lines);
  expect(order).toEqual([1, 2, 4, 3, 0]);
  const shown = order.flatMap((each) => lines[each] ?? []);
  expect(shortNames(shown)).toEqual([
    "Eraser contact",
    "Arm force",
    "commanded force",
    "speed",
    "commanded speed",
  ]);
  expect(colourLines(shown)).toEqual([0, 1, 1, 2, 2]);
  expect(shown.map((each) => each.isDashed)).toEqual([false, false, true, false, true]);
});

test("the names of many lines do not leave the drawing", () => {
  const lines = ["A", "B", "C", "D", "E"].map((each) => makeLine("force", each));
  const drawing = drawSvg({ lines, columns: [[0, 1], ...lines.map(() => [1, 2])] }, [0, 1]);
  const names = [...drawing.matchAll(/<text x="(\d+)" y="(\d+)" fill/g)];
  expect(names).toHaveLength(5);
  expect(Math.max(...names.map((each) => Number(each[1])))).toBeLessThan(800);
  expect(names.every((each) => Number(each[2]) > 0)).toBe(true);
});

test("signals are written as a table and as a drawing with their gaps", () => {
  const plotted = {
    lines: [FORCE, SPEED],
    columns: [
      [0, 1, 2, 3],
      [5, null, 7, 8],
      [0, 0, 0, 1],
    ],
  };
  expect(writeCsv(plotted)).toBe("time [s],force at Arm [N],speed of Arm [m/s]\n0,5,0\n1,,0\n2,7,0\n3,8,1\n");
  const drawing = drawSvg(plotted, [0, 3]);
  const paths = [...drawing.matchAll(/fill="none" stroke="#[0-9a-f]+" d="([^"]*)"/g)].map(
    (each) => each[1] ?? "",
  );
  expect(paths.map((each) => each.split("M").length - 1)).toEqual([2, 1]);
  expect(drawing).toContain("force at Arm");
});
