// Where labels are, and what controls over the picture cover of it.
import { expect, test } from "vitest";
import { Vector3 } from "three";
import { topCover } from "../../src/scene3d/framing";
import { placeLabels, type Label } from "../../src/scene3d/labels";

const label = (key: string, rank: number): Label => ({
  key,
  text: "Whiteboard-1",
  at: new Vector3(),
  kind: "name",
  rank,
});

test("a label at an edge of the picture is moved into it", () => {
  const at = (x: number) => placeLabels([label("one", 1)], () => ({ x, y: 100 }), 400).get("one")?.x ?? NaN;
  expect(at(200)).toBe(200);
  expect(at(395)).toBeLessThan(400 - 40);
  expect(at(2)).toBeCloseTo(400 - at(398));
});

test("of labels at one place the less important one is below, or left out", () => {
  const labels = [1, 2, 3].map((rank) => label(`${rank}`, rank));
  const places = placeLabels(labels, () => ({ x: 200, y: 100 }), 400);
  expect([...places.keys()]).toEqual(["3", "2"]);
  expect(places.get("2")?.y).toBeGreaterThan(places.get("3")?.y ?? Infinity);
});

test("controls at the top cover the picture, a note at the bottom does not", () => {
  const box = (top: number, bottom: number) => ({ left: 0, right: 100, top, bottom });
  expect(topCover([box(8, 32), box(40, 64), box(380, 400)], 400)).toBe(64);
  expect(topCover([box(380, 400)], 400)).toBe(0);
  expect(topCover([], 400)).toBe(0);
});
