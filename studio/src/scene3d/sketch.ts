// The lines over the picture: frames of things and tools, planned postures and paths, and what is measured.
import type * as three from "three";
import { sketchPostures } from "./ghosts";
import { poseOf } from "./kinematics";
import { axesOf, pathOf, type Segment } from "./lines";
import type { SceneTheme } from "./theme";
import type { CellModel, PoseNumbers, SceneSources } from "./types";

const FRAME_M = 0.1;

/** Return the solid and the dashed lines; frames of what is selected, of all things and tools with `allFrames`. */
export function sketch(
  model: CellModel,
  poses: readonly PoseNumbers[],
  { sample, selected, paths, postures }: SceneSources,
  allFrames: boolean,
  measured: readonly three.Vector3[],
  theme: SceneTheme,
): [axes: Segment[], dashed: Segment[]] {
  const framed = allFrames ? Object.keys(model.individuals) : [];
  const things = [...new Set([...framed, ...selected.value])].map((each) => poseOf(model, poses, each));
  const tools = allFrames ? Object.values(sample.value?.arms ?? {}).map(({ tool }) => tool) : [];
  const axes = [...things, ...tools].flatMap((each) => (each === null ? [] : axesOf(each, FRAME_M)));
  const dashed = paths.value.flatMap((path) => pathOf(path, theme.believed));
  const [toolAxes, ways] = sketchPostures(postures.value, theme.accent);
  axes.push(...toolAxes);
  dashed.push(...ways);
  const [from, to] = measured;
  if (from !== undefined && to !== undefined)
    dashed.push({ from: from.toArray(), to: to.toArray(), colour: theme.ink });
  return [axes, dashed];
}
