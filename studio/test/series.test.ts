import { expect, test } from "vitest";
import { ArmMeter, Series } from "../src/state/series";
import type { Sample } from "../src/api/types";

test("a series keeps the newest rows, in order, without repeated times", () => {
  const series = new Series([{ name: "f", unit: "N" }], 3);
  for (const time of [1, 2, 2, 3, 4, 5]) series.add(time, time === 4 ? [] : [time * 10]);
  expect(series.length).toBe(3);
  expect(series.columns()).toEqual([
    [3, 4, 5],
    [30, null, 50],
  ]);
});

test("an arm is measured by the length of its force and the way of its tool", () => {
  const at = (time_s: number, x: number): Sample => ({
    cell: "c",
    time_s,
    things: {},
    arms: {
      a: {
        joints: [],
        speeds: [],
        base: [0, 0, 0, 1, 0, 0, 0],
        tool: [x, 0, 0, 1, 0, 0, 0],
        wrench: [3, 4, 0, 9, 9, 9],
      },
    },
  });
  const meter = new ArmMeter();
  expect(meter.measure(at(1, 0), "a")).toEqual([5, NaN]);
  expect(meter.measure(at(1.5, 0.1), "a")).toEqual([5, 0.2]);
  expect(meter.measure(at(2, 0.1), "b")).toEqual([NaN, NaN]);
});
