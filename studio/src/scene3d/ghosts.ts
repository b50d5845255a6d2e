// The postures of a step of a plan: the arm and its hand as a ghost, at each pose to which its tool is to go.
import * as three from "three";
import { BodyBatch } from "./batch";
import { bodiesUnder, placeArm } from "./kinematics";
import { axesOf, pathOf, type Segment } from "./lines";
import { makeGhost } from "./materials";
import type { CellModel, PlannedPosture, PoseNumbers, Sample, Vector } from "./types";

/** How many postures are drawn as arms at most, evenly chosen: more hide each other. Frames and paths have all. */
export const MOST_ARMS = 6;
const FRAME_M = 0.06;

export class PostureGhosts {
  readonly group = new three.Group();
  private readonly geometries: ReadonlyMap<number, three.BufferGeometry>;
  private readonly batches: BodyBatch[] = [];

  /** `geometries` are those of the bodies of the model, by number. */
  constructor(
    private readonly model: CellModel,
    geometries: ReadonlyMap<number, three.BufferGeometry>,
    private readonly colour: three.Color,
  ) {
    const arms = Object.keys(model.arms).flatMap((arm) => model.individuals[arm]?.body ?? []);
    this.geometries = new Map(
      arms
        .flatMap((arm) => bodiesUnder(model, arm))
        .flatMap((body) => {
          const geometry = geometries.get(body);
          return geometry === undefined ? [] : [[body, geometry]];
        }),
    );
  }

  /** Draw arms in these postures; one whose base is not known stands where it is in the sample. */
  show(postures: readonly PlannedPosture[], sample: Sample | null): void {
    const drawn = thinOut(postures, MOST_ARMS);
    while (this.batches.length < drawn.length) this.add();
    this.batches.forEach((batch, index) => {
      const poses = placePosture(this.model, drawn[index], sample);
      for (const [body, pose] of poses) batch.place(body, pose);
      batch.show(new Set(poses.keys()));
    });
  }

  dispose(): void {
    for (const each of this.batches) each.dispose();
  }

  private add(): void {
    const batch = new BodyBatch(this.geometries, makeGhost(this.colour));
    this.batches.push(batch);
    this.group.add(batch.mesh);
  }
}

function placePosture(
  model: CellModel,
  posture: PlannedPosture | undefined,
  sample: Sample | null,
): Map<number, PoseNumbers> {
  const base = posture?.base ?? sample?.arms[posture?.arm ?? ""]?.base;
  if (posture === undefined || base === undefined) return new Map();
  return placeArm(model, posture.arm, posture.joints, base);
}

/** Return at most so many of some, evenly chosen, the first and the last among them. */
export function thinOut<T>(all: readonly T[], most: number): T[] {
  if (all.length <= most) return [...all];
  const step = (all.length - 1) / (most - 1);
  return Array.from({ length: most }, (_, index) => all[Math.round(index * step)] as T);
}

/** Return the frames of tools in postures, and for each arm the way from one to the next. */
export function sketchPostures(
  postures: readonly PlannedPosture[],
  colour: three.Color,
): [axes: Segment[], dashed: Segment[]] {
  const arms = [...new Set(postures.map(({ arm }) => arm))];
  const ways = arms.map((arm): Vector[] =>
    postures.filter((each) => each.arm === arm).map(({ tool }) => [tool[0], tool[1], tool[2]]),
  );
  return [
    postures.flatMap(({ tool }) => axesOf(tool, FRAME_M)),
    ways.flatMap((each) => pathOf(each, colour)),
  ];
}
