// Poses as seven numbers: position in m, then the unit quaternion (w, x, y, z). Functions return new poses.
import type { PoseNumbers, Vector } from "./types";

export const IDENTITY: PoseNumbers = [0, 0, 0, 1, 0, 0, 0];
type Quaternion = readonly [number, number, number, number];

/** Return `inner`, which is given in the frame `outer`, in the parent of `outer`. */
export function compose(outer: PoseNumbers, inner: PoseNumbers): PoseNumbers {
  const [x, y, z] = transform(outer, [inner[0], inner[1], inner[2]]);
  const [w, a, b, c] = multiply(turnOf(outer), turnOf(inner));
  return [x, y, z, w, a, b, c];
}

/** Return the pose of the parent in the frame of a pose. */
export function invert(pose: PoseNumbers): PoseNumbers {
  const [w, a, b, c] = turnOf(pose);
  const turn: Quaternion = [w, -a, -b, -c];
  const [x, y, z] = rotate(turn, [-pose[0], -pose[1], -pose[2]]);
  return [x, y, z, ...turn];
}

/** Return a point of the frame of a pose in its parent. */
export function transform(pose: PoseNumbers, point: Vector): Vector {
  const [x, y, z] = rotate(turnOf(pose), point);
  return [x + pose[0], y + pose[1], z + pose[2]];
}

/** Return the rotation by an angle in rad about an axis of length 1. */
export function turnAbout(axis: Vector, angle: number): Quaternion {
  const s = Math.sin(angle / 2);
  return [Math.cos(angle / 2), axis[0] * s, axis[1] * s, axis[2] * s];
}

export function turnOf(pose: PoseNumbers): Quaternion {
  return [pose[3], pose[4], pose[5], pose[6]];
}

export function multiply(p: Quaternion, q: Quaternion): Quaternion {
  return [
    p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
    p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
    p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
    p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
  ];
}

/** Return a vector after a rotation: v + 2 w (u x v) + 2 u x (u x v), u being the vector part. */
export function rotate(turn: Quaternion, [x, y, z]: Vector): Vector {
  const [w, a, b, c] = turn;
  const [tx, ty, tz] = [2 * (b * z - c * y), 2 * (c * x - a * z), 2 * (a * y - b * x)];
  return [x + w * tx + b * tz - c * ty, y + w * ty + c * tx - a * tz, z + w * tz + a * ty - b * tx];
}

/** Return how far two poses are apart: in m, and in rad. */
export function difference(one: PoseNumbers, other: PoseNumbers): [metres: number, radians: number] {
  const way = Math.hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]);
  const cosine = one[3] * other[3] + one[4] * other[4] + one[5] * other[5] + one[6] * other[6];
  return [way, 2 * Math.acos(Math.min(1, Math.abs(cosine)))];
}
