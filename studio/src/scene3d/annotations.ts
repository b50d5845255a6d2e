// What is written into the picture: names, what is selected with its size, how far belief is off, forces, distances.
import * as three from "three";
import { describeOffset, type Offset } from "./offsets";
import type { SceneBodies } from "./bodies";
import type { DrawnForce } from "./forces";
import type { Label } from "./labels";
import { transform } from "./poses";
import type { CellModel, PoseNumbers, SceneOptions, Vector } from "./types";

export interface Annotated {
  model: CellModel;
  bodies: SceneBodies;
  poses: readonly PoseNumbers[];
  selected: readonly string[];
  offsets: readonly Offset[];
  forces: readonly DrawnForce[];
  measured: readonly three.Vector3[];
  options: SceneOptions;
}

/** Return the labels of a picture. */
export function annotate(shown: Annotated): Label[] {
  return [...nameThings(shown), ...nameOffsets(shown), ...nameForces(shown), ...nameDistance(shown.measured)];
}

const RANKS: Readonly<Record<string, number>> = { arm: 4, tool: 4, surface: 3, base: 2, fixture: 2, body: 1 };

function nameThings({ model, bodies, poses, selected, options }: Annotated): Label[] {
  return Object.entries(model.individuals).flatMap(([iri, { label, kind }]): Label[] => {
    const isSelected = selected.includes(iri);
    if (!isSelected && (!options.labels || kind === "gripper")) return [];
    const at = topOf(bodies.boxOf(poses, iri));
    if (at === null) return [];
    const text = isSelected ? `${shorten(label)}${describeSize(bodies.sizeOf(iri))}` : shorten(label);
    const rank = isSelected ? 10 : (RANKS[kind] ?? 1);
    return [{ key: `name ${iri}`, text, at, kind: isSelected ? "selected" : "name", rank }];
  });
}

function nameOffsets({ model, bodies, poses, offsets, options }: Annotated): Label[] {
  if (options.reality !== "both") return [];
  return offsets.flatMap((each): Label[] => {
    const at = topOf(bodies.boxOf(poses, each.individual));
    if (at === null) return [];
    const [x, y, z] = transform(each.shift, [at.x, at.y, at.z]);
    const text = `${shorten(model.individuals[each.individual]?.label ?? "")} is ${each.why} ${describeOffset(each)}`;
    return [
      { key: `belief ${each.individual}`, text, at: new three.Vector3(x, y, z), kind: "believed", rank: 8 },
    ];
  });
}

function nameForces({ forces }: Annotated): Label[] {
  return forces.map(({ tip, text }, index) => ({
    key: `force ${index}`,
    text,
    at: new three.Vector3(...tip),
    kind: "force",
    rank: 9,
  }));
}

function nameDistance([from, to]: readonly three.Vector3[]): Label[] {
  if (from === undefined) return [];
  if (to === undefined) return [{ key: "measure", text: "to …", at: from, kind: "measure", rank: 11 }];
  const way: Vector = [to.x - from.x, to.y - from.y, to.z - from.z];
  const parts = way.map((each, axis) => `${"xyz"[axis] ?? ""} ${each.toFixed(3)}`).join("  ");
  const at = from.clone().lerp(to, 0.5);
  return [
    { key: "measure", text: `${from.distanceTo(to).toFixed(3)} m   ${parts}`, at, kind: "measure", rank: 11 },
  ];
}

/** Return a name without its prefix. */
function shorten(label: string): string {
  return label.slice(label.indexOf(":") + 1);
}

function describeSize(size: three.Vector3 | null): string {
  return size === null
    ? ""
    : `  ${size
        .toArray()
        .map((each) => each.toFixed(3))
        .join(" × ")} m`;
}

function topOf(box: three.Box3): three.Vector3 | null {
  if (box.isEmpty()) return null;
  const centre = box.getCenter(new three.Vector3());
  return centre.setZ(box.max.z);
}
