// What is in the picture, and where a point of the world is in it.
import * as three from "three";
import type { SceneBodies } from "./bodies";
import { poseOf } from "./kinematics";
import type { Box } from "./labels";
import type { CellModel, PoseNumbers, SceneSources } from "./types";

const LEAST_M = 0.15;

/** How far from an arm, in m, a thing is that it may work on, and how large at most. */
const [REACH_M, WORK_M] = [1, 3];

/** Return the box around the arms and what they may work on: a hall around them is not looked at first. */
export function boxOfWork(
  individuals: CellModel["individuals"],
  boxOf: (individual: string) => three.Box3,
): three.Box3 {
  const arms = new three.Box3();
  const ofArms = (kind: string): boolean => kind === "arm" || kind === "gripper" || kind === "base";
  for (const [each, { kind }] of Object.entries(individuals)) if (ofArms(kind)) arms.union(boxOf(each));
  if (arms.isEmpty()) return arms;
  const [near, work] = [arms.clone().expandByScalar(REACH_M), arms.clone()];
  for (const [each, { kind }] of Object.entries(individuals)) {
    const box = ofArms(kind) ? new three.Box3() : boxOf(each);
    const size = box.getSize(new three.Vector3());
    if (!box.isEmpty() && box.intersectsBox(near) && Math.max(...size.toArray()) < WORK_M) work.union(box);
  }
  return work;
}

/** Return the sphere that is to be seen: that around what is selected, else around the robots and their work. */
export function frameThese(
  bodies: SceneBodies | null,
  individuals: CellModel["individuals"],
  poses: readonly PoseNumbers[],
  selected: readonly string[],
): three.Sphere {
  const box = new three.Box3();
  if (bodies !== null) for (const each of selected) box.union(bodies.boxOf(poses, each));
  if (bodies !== null && box.isEmpty()) box.copy(boxOfWork(individuals, (each) => bodies.boxOf(poses, each)));
  if (bodies !== null && box.isEmpty()) box.copy(bodies.boxOf(poses));
  if (box.isEmpty()) return new three.Sphere(new three.Vector3(), 1);
  const sphere = box.getBoundingSphere(new three.Sphere());
  sphere.radius = Math.max(LEAST_M, sphere.radius);
  return sphere;
}

/** Whether a robot has driven out of the picture of a camera; where something is selected, that is looked at. */
export function hasRobotLeft(
  { model: { value: model }, selected }: Pick<SceneSources, "model" | "selected">,
  poses: readonly PoseNumbers[],
  camera: three.Camera,
): boolean {
  if (model === null || selected.value.length > 0) return false;
  return Object.entries(model.individuals).some(([individual, { kind }]) => {
    const pose = kind === "arm" || kind === "base" ? poseOf(model, poses, individual) : null;
    return pose !== null && projectTo(camera, 1, 1, new three.Vector3(pose[0], pose[1], pose[2])) === null;
  });
}

/** Return how much of a picture of a height is covered at its top, in pixels: by what ends in its upper half. */
export function topCover(covered: readonly Box[], height: number): number {
  return Math.max(0, ...covered.map(({ bottom }) => bottom).filter((each) => each < height / 2));
}

/** Return where a point is in a picture of a size in pixels; null if it is outside. */
export function projectTo(
  camera: three.Camera,
  width: number,
  height: number,
  at: three.Vector3,
): { x: number; y: number } | null {
  const { x, y, z } = at.clone().project(camera);
  const isSeen = z < 1 && Math.abs(x) < 1 && Math.abs(y) < 1;
  return isSeen ? { x: ((x + 1) / 2) * width, y: ((1 - y) / 2) * height } : null;
}
