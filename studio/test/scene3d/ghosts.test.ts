// Arms in the postures of a step of a plan, and which postures those are.
import * as three from "three";
import { expect, test } from "vitest";
import { sketchPostures, thinOut } from "../../src/scene3d/ghosts";
import { placeArm } from "../../src/scene3d/kinematics";
import type { Body, CellModel, PlannedPosture, PoseNumbers } from "../../src/scene3d/types";
import type { OperationState } from "../../src/state/operation";
import { posturesOf, posturesOfCall } from "../../src/state/plan_step";

const at = (x: number, z = 0): PoseNumbers => [x, 0, z, 1, 0, 0, 0];
const body = (name: string, parent: number, z: number, isTurned: boolean): Body => ({
  name,
  parent,
  pose: at(0, z),
  joints: isTurned
    ? [{ name: `${name}/joint`, kind: "hinge", axis: [0, 1, 0], anchor: [0, 0, 0], rest: 0 }]
    : [],
  geoms: [],
  individual: null,
});
const model: CellModel = {
  bodies: [
    body("crate", -1, 0, false),
    body("base", -1, 0, false),
    body("upper", 1, 1, true),
    body("hand", 2, 1, true),
  ],
  meshes: [],
  individuals: { Arm: { label: "Arm", body: 1, frame: at(0), kind: "arm", movable: false } },
  arms: { Arm: { joints: ["upper/joint", "hand/joint"] } },
};

test("an arm is where its base is, bent by its joints, with its hand and nothing else", () => {
  const poses = placeArm(model, "Arm", [Math.PI / 2, 0], at(5));
  expect([...poses.keys()]).toEqual([1, 2, 3]);
  expect(poses.get(2)?.slice(0, 3)).toEqual([5, 0, 1]);
  const [x, y, z] = poses.get(3) ?? at(0);
  expect([x, y, z].map((each) => Math.round(each * 1e6) / 1e6)).toEqual([6, 0, 1]);
  expect(placeArm(model, "Nobody", [], at(0)).size).toBe(0);
});

test("of many postures some are drawn, the first and the last among them", () => {
  expect(thinOut([1, 2, 3], 6)).toEqual([1, 2, 3]);
  expect(thinOut([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10], 6)).toEqual([0, 2, 4, 6, 8, 10]);
});

test("the way of each arm leads from one pose of its tool to the next", () => {
  const posture = (arm: string, x: number): PlannedPosture => ({ arm, joints: [], base: null, tool: at(x) });
  const [axes, ways] = sketchPostures(
    [posture("A", 0), posture("B", 5), posture("A", 1)],
    new three.Color(1, 0, 0),
  );
  expect(axes).toHaveLength(9);
  expect(ways.map(({ from, to }) => [from, to])).toEqual([
    [
      [0, 0, 0],
      [1, 0, 0],
    ],
  ]);
});

test("a step has the postures of its number, and a call those of the step that it is in while that runs", () => {
  const pose = { type: "pose" as const, position_m: [0, 0, 0] as [number, number, number] };
  const tool = { ...pose, quaternion_wxyz: [1, 0, 0, 0] as [number, number, number, number] };
  const arm = { type: "iri" as const, iri: "Arm", label: "Arm" };
  const postures = [1, 2, 2].map((step) => ({ step, arm, q: [step], tool, base: tool }));
  const space = { checked: 2, steps: 2, postures };
  expect(posturesOf(space, 2)).toEqual(postures.slice(1));
  expect(posturesOf(space, null)).toBe(posturesOf(null, 1));
  const call = (key: number, parent: number, status: string) => [key, { key, parent, status }] as const;
  const state = {
    nodes: new Map([call(1, 0, "success"), call(2, 0, "running"), call(3, 2, "running")]),
    attempts: [{ plan: { space }, nodes: [1, 2] }],
  } as unknown as OperationState;
  expect([1, 2, 3, 9].map((key) => posturesOfCall(state, key).length)).toEqual([0, 2, 2, 0]);
});
