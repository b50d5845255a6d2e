// The way of a gripper over samples.
import { expect, test } from "vitest";
import { findPaths } from "../../src/scene3d/paths";
import type { CellModel, PoseNumbers, Sample } from "../../src/scene3d/types";

const at = (x: number): PoseNumbers => [x, 0, 0, 1, 0, 0, 0];
const body = (name: string, individual: string) => ({
  name,
  parent: -1,
  pose: at(0),
  joints: [],
  geoms: [],
  individual,
});
const model: CellModel = {
  bodies: [body("hand", "Hand"), body("crate", "Crate")],
  meshes: [],
  individuals: {
    Hand: { label: "Hand", body: 0, frame: [0, 0, 0.1, 1, 0, 0, 0], kind: "gripper", movable: false },
    Crate: { label: "Crate", body: 1, frame: at(0), kind: "body", movable: true },
  },
  arms: {},
};
const sample = (time_s: number, x: number): Sample => ({
  cell: "",
  time_s,
  arms: {},
  things: {},
  bodies: { hand: [...at(x)], crate: [...at(2 * x)] },
});

test("a path has where the gripper was, but not where it stood still", () => {
  const samples = [sample(0, 0), sample(0.1, 0.001), sample(0.2, 0.2), sample(0.3, 0.2), sample(0.4, 0.1)];
  expect(findPaths(model, samples)).toEqual([
    [
      [0, 0, 0.1],
      [0.2, 0, 0.1],
      [0.1, 0, 0.1],
    ],
  ]);
});

test("what has not moved has no path", () => {
  expect(findPaths(model, [sample(0, 0), sample(1, 0)])).toEqual([]);
});
