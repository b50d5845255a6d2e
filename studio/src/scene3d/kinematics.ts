// Where all bodies of a cell are, from a sample of it: forward kinematics as MuJoCo does it.
import { compose, IDENTITY, invert, multiply, rotate, transform, turnAbout, turnOf } from "./poses";
import type { Body, CellModel, Joint, PoseNumbers, Sample } from "./types";

/** Return the pose of each body in the world; without a sample, that with all joints at rest. */
export function placeBodies(model: CellModel, sample: Sample | null): PoseNumbers[] {
  const values = sample === null ? new Map<string, number>() : readJoints(model, sample);
  const known = sample === null ? new Map<number, PoseNumbers>() : readPoses(model, sample);
  return chainBodies(model, values, known);
}

/** Return the poses of the bodies of an arm and its hand, by number, in a posture; `base` is where the arm stands. */
export function placeArm(
  model: CellModel,
  arm: string,
  joints: readonly number[],
  base: PoseNumbers,
): Map<number, PoseNumbers> {
  const [own, individual] = [model.arms[arm], model.individuals[arm]];
  if (own === undefined || individual === undefined) return new Map();
  const values = new Map(own.joints.map((name, index) => [name, joints[index] ?? 0]));
  const known = new Map([[individual.body, compose(base, invert(individual.frame))]]);
  const poses = chainBodies(model, values, known);
  return new Map(bodiesUnder(model, individual.body).map((body) => [body, poses[body] ?? IDENTITY]));
}

/** Return the numbers of a body and of all that it carries. */
export function bodiesUnder(model: CellModel, body: number): number[] {
  const found = new Set([body]);
  model.bodies.forEach(({ parent }, number) => {
    if (found.has(parent)) found.add(number);
  });
  return [...found];
}

function chainBodies(
  model: CellModel,
  values: ReadonlyMap<string, number>,
  known: ReadonlyMap<number, PoseNumbers>,
): PoseNumbers[] {
  const poses: PoseNumbers[] = [];
  model.bodies.forEach((body, number) => {
    const parent = poses[body.parent] ?? IDENTITY;
    poses.push(known.get(number) ?? applyJoints(body, compose(parent, body.pose), values));
  });
  return poses;
}

/** Return the values of joints, by name. */
function readJoints(model: CellModel, sample: Sample): Map<string, number> {
  const values = new Map(Object.entries(sample.joints ?? {}));
  for (const [iri, arm] of Object.entries(model.arms))
    arm.joints.forEach((name, index) => {
      const angle = sample.arms[iri]?.joints[index];
      if (angle !== undefined) values.set(name, angle);
    });
  return values;
}

/** Return the poses of the bodies that a sample places, by itself or by their individuals. */
function readPoses(model: CellModel, sample: Sample): Map<number, PoseNumbers> {
  const poses = new Map<number, PoseNumbers>();
  const recorded = sample.bodies ?? {};
  model.bodies.forEach(({ name }, number) => {
    const own = recorded[name];
    if (own !== undefined) poses.set(number, own);
  });
  for (const [iri, individual] of Object.entries(model.individuals)) {
    const own = sample.arms[iri]?.base ?? sample.things[iri];
    if (own !== undefined) poses.set(individual.body, compose(own, invert(individual.frame)));
  }
  return poses;
}

function applyJoints(body: Body, rest: PoseNumbers, values: ReadonlyMap<string, number>): PoseNumbers {
  return body.joints.reduce(
    (pose, joint) => applyJoint(joint, pose, values.get(joint.name) ?? joint.rest),
    rest,
  );
}

/** Return the pose of a body that a joint moves; one with several values stays as it is. */
function applyJoint(joint: Joint, pose: PoseNumbers, value: number): PoseNumbers {
  const by = value - joint.rest;
  if (joint.kind === "slide") {
    const [x, y, z] = rotate(turnOf(pose), [joint.axis[0] * by, joint.axis[1] * by, joint.axis[2] * by]);
    return [pose[0] + x, pose[1] + y, pose[2] + z, ...turnOf(pose)];
  }
  if (joint.kind !== "hinge") return pose;
  const anchor = transform(pose, joint.anchor);
  const turn = multiply(turnOf(pose), turnAbout(joint.axis, by));
  const [x, y, z] = rotate(turn, joint.anchor);
  return [anchor[0] - x, anchor[1] - y, anchor[2] - z, ...turn];
}

/** Return the pose of an individual's own frame, if the model has it. */
export function poseOf(model: CellModel, poses: readonly PoseNumbers[], iri: string): PoseNumbers | null {
  const individual = model.individuals[iri];
  const body = individual === undefined ? undefined : poses[individual.body];
  return individual === undefined || body === undefined ? null : compose(body, individual.frame);
}
