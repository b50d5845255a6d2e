// Things that are not where they are believed to be, and hands that are not where they are commanded to be.
import { poseOf } from "./kinematics";
import { compose, difference, invert } from "./poses";
import type { BelievedPoses, CellModel, PoseNumbers, Sample } from "./types";

const LEAST_M = 0.002;
const LEAST_RAD = 0.01;
/** What an arm that yields, or is on its way, is behind by all the time is not marked: 1 cm and 2 degrees. */
const LAG_M = 0.01;
const LAG_RAD = 0.035;

/** An individual that is not where it is believed, or commanded, to be: `shift` moves it there, in the world. */
export interface Offset {
  individual: string;
  shift: PoseNumbers;
  metres: number;
  radians: number;
  why: "believed" | "commanded";
}

/** Return what is elsewhere than believed, and the hands that are elsewhere than commanded. */
export function findOffsets(
  model: CellModel,
  poses: readonly PoseNumbers[],
  believed: BelievedPoses,
  sample: Sample | null,
): Offset[] {
  return [...findMisbeliefs(model, poses, believed), ...findLags(model, sample)];
}

/** Return the individuals whose believed poses differ from the true ones by more than 2 mm or 0.6 degrees. */
function findMisbeliefs(model: CellModel, poses: readonly PoseNumbers[], believed: BelievedPoses): Offset[] {
  return Object.entries(model.individuals).flatMap(([individual, { kind }]) => {
    const [there, truth] = [believed[individual], poseOf(model, poses, individual)];
    if (there === undefined || truth === null || kind === "arm" || kind === "gripper") return [];
    const [metres, radians] = difference(there, truth);
    if (metres < LEAST_M && radians < LEAST_RAD) return [];
    return [{ individual, shift: compose(there, invert(truth)), metres, radians, why: "believed" }];
  });
}

/** Return the hands, or arms without one, whose tools are measured elsewhere than they are commanded to be. */
function findLags(model: CellModel, sample: Sample | null): Offset[] {
  return Object.entries(sample?.arms ?? {}).flatMap(([arm, { tool, reference }]): Offset[] => {
    if (reference === null || reference === undefined) return [];
    const [metres, radians] = difference(reference, tool);
    if (metres < LAG_M && radians < LAG_RAD) return [];
    const shift = compose(reference, invert(tool));
    return [{ individual: findHand(model, arm) ?? arm, shift, metres, radians, why: "commanded" }];
  });
}

/** Return the hand that an arm carries; undefined without one. */
function findHand(model: CellModel, arm: string): string | undefined {
  return Object.entries(model.individuals).find(
    ([, { kind, body }]) => kind === "gripper" && isPartOf(model, body, arm),
  )?.[0];
}

function isPartOf(model: CellModel, body: number, arm: string): boolean {
  for (let at = body; at >= 0; at = model.bodies[at]?.parent ?? -1)
    if (model.bodies[at]?.individual === arm) return true;
  return false;
}

/** Return how something is off, as text: in mm below 10 cm, in degrees if it is only turned. */
export function describeOffset({ metres, radians }: Offset): string {
  if (metres < LEAST_M) return `turned by ${((radians * 180) / Math.PI).toFixed(1)}°`;
  return `${metres < 0.1 ? `${(metres * 1000).toFixed(0)} mm` : `${metres.toFixed(2)} m`} away`;
}

/** Return the poses that move individuals to where they are believed to be. */
export function shiftsOf(offsets: readonly Offset[]): ReadonlyMap<string, PoseNumbers> {
  return new Map(offsets.map((each) => [each.individual, each.shift]));
}
