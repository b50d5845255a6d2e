// The bodies of a cell: solid where they really are, a ghost where belief differs, with an outline if they are selected.
import * as three from "three";
import { BodyBatch } from "./batch";
import { PostureGhosts } from "./ghosts";
import { makeGhost, makeOutline, makeShadow, makeSolid, makeTranslucent } from "./materials";
import { compose } from "./poses";
import { makeBodyGeometry, matrixOf, shareNormals } from "./shapes";
import type { SceneTheme } from "./theme";
import type { CellModel, PlannedPosture, PoseNumbers, Sample } from "./types";

export class SceneBodies {
  readonly group = new three.Group();
  private readonly solid: BodyBatch;
  private readonly shadow: BodyBatch;
  private readonly translucent: BodyBatch;
  private readonly ghost: BodyBatch;
  private readonly dragged: BodyBatch;
  private readonly draggedMaterial: three.MeshLambertMaterial;
  private readonly outline: BodyBatch;
  private readonly planned: PostureGhosts;
  private readonly all: readonly BodyBatch[];
  private readonly boxes = new Map<number, three.Box3>();
  private readonly owned = new Map<string, Set<number>>();

  constructor(
    private readonly model: CellModel,
    theme: SceneTheme,
  ) {
    const opaque = this.makeGeometries(true);
    const glass = this.makeGeometries(false);
    this.solid = new BodyBatch(opaque, makeSolid());
    this.shadow = new BodyBatch(opaque, makeShadow(theme));
    this.shadow.mesh.renderOrder = -1;
    this.translucent = new BodyBatch(glass, makeTranslucent());
    this.ghost = new BodyBatch(opaque, makeGhost(theme.believed));
    this.draggedMaterial = makeGhost(theme.disturb);
    this.dragged = new BodyBatch(opaque, this.draggedMaterial);
    const hulls = new Map([...opaque].map(([body, geometry]) => [body, shareNormals(geometry.clone())]));
    this.outline = new BodyBatch(hulls, makeOutline(theme.accent));
    this.all = [this.solid, this.shadow, this.translucent, this.ghost, this.dragged, this.outline];
    for (const each of this.all) this.group.add(each.mesh);
    this.planned = new PostureGhosts(model, opaque, theme.accent);
    this.group.add(this.planned.group);
    this.noteBoxes(opaque, glass);
    this.model.bodies.forEach(({ individual }, body) => {
      if (individual !== null)
        this.owned.set(individual, (this.owned.get(individual) ?? new Set()).add(body));
    });
    for (const each of [this.ghost, this.dragged, this.outline]) each.show(new Set());
    this.translucent.show(new Set(glass.keys()));
  }

  /** Put all bodies at their poses; those of the individuals in `shifts` are moved by a pose in the world. */
  place(poses: readonly PoseNumbers[], shifts: ReadonlyMap<string, PoseNumbers>): void {
    poses.forEach((pose, body) => {
      const shift = shifts.get(this.model.bodies[body]?.individual ?? "");
      const there = shift === undefined ? pose : compose(shift, pose);
      for (const each of [this.solid, this.shadow, this.translucent, this.outline]) each.place(body, there);
    });
  }

  /** Show ghosts of individuals, each moved by a pose in the world. */
  placeGhosts(poses: readonly PoseNumbers[], shifts: ReadonlyMap<string, PoseNumbers>): void {
    this.placeShifted(this.ghost, poses, shifts);
  }

  /** Show where a thing is being moved to, in a colour of its own. */
  placeDragged(
    poses: readonly PoseNumbers[],
    shifts: ReadonlyMap<string, PoseNumbers>,
    colour: three.Color,
  ): void {
    this.draggedMaterial.color.copy(colour);
    this.placeShifted(this.dragged, poses, shifts);
  }

  /** Show arms in planned postures. */
  placePlanned(postures: readonly PlannedPosture[], sample: Sample | null): void {
    this.planned.show(postures, sample);
  }

  outlineThese(individuals: readonly string[]): void {
    this.outline.show(new Set(individuals.flatMap((each) => [...(this.owned.get(each) ?? [])])));
  }

  /** Return the individual that a ray hits first, and where; null if it hits none. */
  pick(raycaster: three.Raycaster): { individual: string; point: three.Vector3 } | null {
    for (const hit of raycaster.intersectObjects([this.solid.mesh, this.translucent.mesh], false)) {
      const batch = hit.object === this.solid.mesh ? this.solid : this.translucent;
      const individual = this.model.bodies[batch.bodyOf(hit)]?.individual ?? null;
      if (individual !== null) return { individual, point: hit.point };
    }
    return null;
  }

  /** Return the box of individuals in the world, of all of them without any; it is empty if they have no shapes. */
  boxOf(poses: readonly PoseNumbers[], individual?: string): three.Box3 {
    const box = new three.Box3();
    const bodies = individual === undefined ? this.boxes.keys() : (this.owned.get(individual) ?? []);
    for (const body of bodies) {
      const [own, pose] = [this.boxes.get(body), poses[body]];
      if (own !== undefined && pose !== undefined) box.union(own.clone().applyMatrix4(matrixOf(pose)));
    }
    return box;
  }

  /** Return the size in m, along its own axes, of an individual that is one body. */
  sizeOf(individual: string): three.Vector3 | null {
    const [body, ...others] = this.owned.get(individual) ?? [];
    return others.length > 0 ? null : (this.boxes.get(body ?? -1)?.getSize(new three.Vector3()) ?? null);
  }

  dispose(): void {
    for (const each of [...this.all, this.planned]) each.dispose();
  }

  private placeShifted(
    batch: BodyBatch,
    poses: readonly PoseNumbers[],
    shifts: ReadonlyMap<string, PoseNumbers>,
  ): void {
    const shown = new Set<number>();
    for (const [individual, shift] of shifts)
      for (const body of this.owned.get(individual) ?? []) {
        const pose = poses[body];
        if (pose === undefined) continue;
        batch.place(body, compose(shift, pose));
        shown.add(body);
      }
    batch.show(shown);
  }

  private makeGeometries(opaque: boolean): Map<number, three.BufferGeometry> {
    const made = new Map<number, three.BufferGeometry>();
    this.model.bodies.forEach((body, number) => {
      const geometry = makeBodyGeometry(this.model, body, opaque);
      if (geometry !== null) made.set(number, geometry);
    });
    return made;
  }

  private noteBoxes(...all: ReadonlyMap<number, three.BufferGeometry>[]): void {
    for (const [body, geometry] of all.flatMap((each) => [...each])) {
      geometry.computeBoundingBox();
      const box = this.boxes.get(body) ?? new three.Box3();
      this.boxes.set(body, geometry.boundingBox === null ? box : box.union(geometry.boundingBox));
    }
  }
}
