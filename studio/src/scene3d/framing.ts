// What is in the picture, and where a point of the world is in it.
import * as three from "three";
import type { SceneBodies } from "./bodies";
import type { Box } from "./labels";
import type { PoseNumbers } from "./types";

const LEAST_M = 0.15;

/** Return the sphere that is to be seen: that around what is selected, or around everything. */
export function frameThese(
  bodies: SceneBodies | null,
  poses: readonly PoseNumbers[],
  selected: readonly string[],
): three.Sphere {
  const box = new three.Box3();
  if (bodies !== null) for (const each of selected) box.union(bodies.boxOf(poses, each));
  if (bodies !== null && box.isEmpty()) box.copy(bodies.boxOf(poses));
  if (box.isEmpty()) return new three.Sphere(new three.Vector3(), 1);
  const sphere = box.getBoundingSphere(new three.Sphere());
  sphere.radius = Math.max(LEAST_M, sphere.radius);
  return sphere;
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
