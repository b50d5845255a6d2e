// Where what is believed differs from what is true.
import { poseOf } from "./kinematics";
import { compose, difference, invert } from "./poses";
import type { BelievedPoses, CellModel, PoseNumbers } from "./types";

const LEAST_M = 0.002;
const LEAST_RAD = 0.01;

/** An individual that is not where it is believed to be: `shift` moves it there, in the world. */
export interface Misbelief {
  individual: string;
  shift: PoseNumbers;
  metres: number;
  radians: number;
}

/** Return the individuals whose believed poses differ from the true ones by more than 2 mm or 0.6 degrees. */
export function findMisbeliefs(
  model: CellModel,
  poses: readonly PoseNumbers[],
  believed: BelievedPoses,
): Misbelief[] {
  return Object.entries(model.individuals).flatMap(([individual, { kind }]) => {
    const [there, truth] = [believed[individual], poseOf(model, poses, individual)];
    if (there === undefined || truth === null || kind === "arm" || kind === "gripper") return [];
    const [metres, radians] = difference(there, truth);
    if (metres < LEAST_M && radians < LEAST_RAD) return [];
    return [{ individual, shift: compose(there, invert(truth)), metres, radians }];
  });
}

/** Return how something is off, as text: in mm below 10 cm, in degrees if it is only turned. */
export function describeDifference({ metres, radians }: Misbelief): string {
  if (metres < LEAST_M) return `turned by ${((radians * 180) / Math.PI).toFixed(1)}°`;
  return `${metres < 0.1 ? `${(metres * 1000).toFixed(0)} mm` : `${metres.toFixed(2)} m`} away`;
}

/** Return the poses that move individuals to where they are believed to be. */
export function shiftsOf(misbeliefs: readonly Misbelief[]): ReadonlyMap<string, PoseNumbers> {
  return new Map(misbeliefs.map((each) => [each.individual, each.shift]));
}
