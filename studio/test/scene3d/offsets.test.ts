// What is elsewhere than believed or commanded is marked above a threshold, and said in words.
import { expect, test } from "vitest";
import { describeOffset, findOffsets } from "../../src/scene3d/offsets";
import type { PoseNumbers } from "../../src/api/types";
import type { Body, CellModel, ModelIndividual, Sample } from "../../src/scene3d/types";

const AT: PoseNumbers = [0, 0, 0, 1, 0, 0, 0];
const at = (z: number): PoseNumbers => [0, 0, z, 1, 0, 0, 0];
const body = (name: string, parent: number, individual: string | null): Body => ({
  name,
  parent,
  pose: AT,
  joints: [],
  geoms: [],
  individual,
});
const individual = (label: string, kind: ModelIndividual["kind"], number: number): ModelIndividual => ({
  label,
  kind,
  body: number,
  frame: AT,
  movable: false,
});

const MODEL: CellModel = {
  bodies: [
    body("world", -1, null),
    body("link", 0, "arm"),
    body("palm", 1, "hand"),
    body("other palm", 0, "other"),
  ],
  meshes: [],
  individuals: {
    arm: individual("lab:Arm-1", "arm", 1),
    other: individual("lab:Hand-2", "gripper", 3),
    hand: individual("lab:Hand-1", "gripper", 2),
  },
  arms: { arm: { joints: [] } },
};

function lag(z: number | null): ReturnType<typeof findOffsets> {
  const reference = z === null ? null : at(z);
  const arm = { joints: [], speeds: [], base: AT, tool: AT, wrench: null, reference };
  const sample: Sample = { cell: "cell", time_s: 0, arms: { arm }, things: {} };
  return findOffsets(MODEL, [AT, AT, AT, AT], {}, sample);
}

test("a hand is marked where its arm is commanded to be elsewhere", () => {
  const [found, ...others] = lag(0.014);
  expect(others).toEqual([]);
  expect(found).toMatchObject({ individual: "hand", why: "commanded", shift: at(0.014) });
  expect(found === undefined ? "" : describeOffset(found)).toBe("14 mm away");
});

test("a small lag is not marked, and neither is an arm that nobody commands", () => {
  expect(lag(0.009)).toEqual([]);
  expect(lag(null)).toEqual([]);
});
