import { expect, test } from "vitest";
import { describeDirt, dirtShare, parseDirtMap } from "../src/state/dirt_map";

test("a map is read in runs within its rows, with the confidence of each", () => {
  const map = parseDirtMap("4x2 3c 2d7 1u 2s");
  expect(map?.runs).toEqual([
    { column: 0, row: 0, length: 3, state: "clean", sure: 1 },
    { column: 3, row: 0, length: 1, state: "dirty", sure: 0.7 },
    { column: 0, row: 1, length: 1, state: "dirty", sure: 0.7 },
    { column: 1, row: 1, length: 1, state: "unseen", sure: 0 },
    { column: 2, row: 1, length: 2, state: "spared", sure: 1 },
  ]);
  expect(map && dirtShare(map, "clean")).toBe(0.5);
  expect(map && describeDirt(map)).toBe("50.0% clean, 33.3% dirty, 16.7% not seen");
});

test.each(["", "4x2", "4x2 3c", "4x2 9c", "4x2 8q", "0x2 1c"])("%j is no map", (text) => {
  expect(parseDirtMap(text)).toBeNull();
});
