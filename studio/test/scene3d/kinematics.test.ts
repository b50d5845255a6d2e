// The kinematics of the page against MuJoCo: `tests/running_cells/kinematics.py` writes the postures and poses.
import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { placeBodies, poseOf } from "../../src/scene3d/kinematics";
import type { CellModel, PoseNumbers, Sample } from "../../src/scene3d/types";

interface Case {
  name: string;
  model: CellModel;
  samples: Sample[];
  poses: PoseNumbers[][];
}
const cases = JSON.parse(readFileSync(new URL("kinematics.json", import.meta.url), "utf8")) as Case[];

describe.each(cases)("the bodies of $name", ({ model, samples, poses }) => {
  it("are where MuJoCo has them, to 1e-6", () => {
    expect(samples.length).toBeGreaterThan(0);
    samples.forEach((sample, index) => {
      const found = placeBodies(model, sample);
      expect(found.length).toBe(poses[index]?.length);
      found.forEach((pose, body) =>
        expect(distance(pose, poses[index]?.[body]), model.bodies[body]?.name).toBeLessThan(1e-6),
      );
    });
  });

  it("are not where they rest", () => {
    const found = placeBodies(model, samples[0] ?? null);
    const resting = placeBodies(model, null);
    const moved = found.filter((pose, body) => distance(pose, resting[body]) > 0.01);
    expect(moved.length).toBeGreaterThan(8);
  });

  it("give the poses of individuals", () => {
    const sample = samples[0];
    if (sample === undefined) throw new Error("there is no sample");
    const found = placeBodies(model, sample);
    const things = Object.entries(sample.things);
    expect(things.length).toBeGreaterThan(0);
    for (const [iri, pose] of things)
      expect(distance(poseOf(model, found, iri) ?? undefined, pose)).toBeLessThan(1e-9);
  });
});

/** The greatest difference of two poses in any number; q and -q are the same rotation. */
function distance(one: PoseNumbers | undefined, other: PoseNumbers | undefined): number {
  if (one === undefined || other === undefined) return Infinity;
  const sign =
    one.slice(3).reduce((sum, each, index) => sum + each * (other[3 + index] ?? NaN), 0) < 0 ? -1 : 1;
  return Math.max(
    ...one.map((each, index) => Math.abs(each - (index < 3 ? 1 : sign) * (other[index] ?? NaN))),
  );
}
