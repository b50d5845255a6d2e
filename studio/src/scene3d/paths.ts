// The ways of grippers in a rehearsal: what is planned, before it is done.
import { placeBodies, poseOf } from "./kinematics";
import type { CellModel, PlannedPath, Sample, Vector } from "./types";

const SHORTEST_M = 0.005;

/** Return the path of each gripper of a cell over samples, without points where it stands still. */
export function findPaths(model: CellModel, samples: readonly Sample[]): PlannedPath[] {
  const grippers = Object.keys(model.individuals).filter((iri) => model.individuals[iri]?.kind === "gripper");
  const paths = new Map<string, Vector[]>(grippers.map((iri) => [iri, []]));
  for (const sample of samples) {
    const poses = placeBodies(model, sample);
    for (const [iri, path] of paths) {
      const pose = poseOf(model, poses, iri);
      const last = path.at(-1);
      if (pose === null) continue;
      const way =
        last === undefined ? Infinity : Math.hypot(...last.map((each, axis) => (pose[axis] ?? each) - each));
      if (way >= SHORTEST_M) path.push([pose[0], pose[1], pose[2]]);
    }
  }
  return [...paths.values()].filter((each) => each.length > 1);
}
