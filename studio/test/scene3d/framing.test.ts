import * as three from "three";
import { expect, test } from "vitest";
import { boxOfWork, hasRobotLeft } from "../../src/scene3d/framing";
import type { CellModel, Source } from "../../src/scene3d/types";

const box = (x: number, size: number) =>
  new three.Box3().setFromCenterAndSize(new three.Vector3(x, 0, 0), new three.Vector3(size, size, size));
const boxes: Record<string, three.Box3> = {
  arm: box(0, 0.6),
  table: box(0.9, 1),
  hall: box(0, 20),
  shelf: box(8, 1),
};
const individual = (kind: "arm" | "fixture") => ({
  label: "",
  body: 0,
  frame: [0, 0, 0, 1, 0, 0, 0] as [number, number, number, number, number, number, number],
  kind,
  movable: false,
});
const boxOf = (each: string): three.Box3 => boxes[each]?.clone() ?? new three.Box3();

test("the robot and its work are framed, not the hall or what is far away", () => {
  const individuals = {
    arm: individual("arm"),
    table: individual("fixture"),
    hall: individual("fixture"),
    shelf: individual("fixture"),
  };
  const framed = boxOfWork(individuals, boxOf);
  expect(framed.min.x).toBeCloseTo(-0.3);
  expect(framed.max.x).toBeCloseTo(1.4);
  expect(boxOfWork({ hall: individual("fixture") }, boxOf).isEmpty()).toBe(true);
});

test("a robot that drives out of the picture has left it, unless something else is looked at", () => {
  const camera = new three.PerspectiveCamera(36, 1, 0.02, 100);
  camera.position.set(0, 0, 5);
  camera.updateMatrixWorld();
  const source = <T>(value: T): Source<T> => ({ value, subscribe: () => () => undefined });
  const model: CellModel = { bodies: [], meshes: [], individuals: { arm: individual("arm") }, arms: {} };
  const hasLeft = (x: number, selected: string[] = []): boolean =>
    hasRobotLeft({ model: source(model), selected: source(selected) }, [[x, 0, 0, 1, 0, 0, 0]], camera);
  expect(hasLeft(0.5)).toBe(false);
  expect(hasLeft(4)).toBe(true);
  expect(hasLeft(4, ["table"])).toBe(false);
});
