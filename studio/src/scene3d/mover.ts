// Moves a thing with the mouse: along the floor, or up and down; nothing happens before it is confirmed.
import { signal } from "@preact/signals";
import * as three from "three";
import type { Move } from "./MoveForm";
import { compose, IDENTITY } from "./poses";
import type { CellModel, Displacement, PoseNumbers, SceneActions, Tool, Vector } from "./types";

const STEP_M = 0.001;

export class Mover {
  readonly move = signal<Move | null>(null);
  private grabbed: { point: three.Vector3; from: Vector } | null = null;

  /** Begin with a tool, and with what is selected if the tool can move it; end with other tools. */
  begin(tool: Tool, model: CellModel | null, selected: string | undefined): void {
    this.grabbed = null;
    if (tool !== "disturb" && tool !== "correct") this.move.value = null;
    else this.move.value = { tool, individual: null, label: "", by_m: [0, 0, 0] };
    if (selected !== undefined) this.choose(model, selected);
  }

  /** Choose what is moved; return whether the tool can move it. */
  choose(model: CellModel | null, individual: string): boolean {
    const now = this.move.value;
    const found = model?.individuals[individual];
    if (now === null || found === undefined || !canMove(now.tool, found.kind, found.movable)) return false;
    const by_m: Vector = now.individual === individual ? now.by_m : [0, 0, 0];
    this.move.value = { ...now, individual, label: found.label, by_m };
    return true;
  }

  grab(point: three.Vector3): void {
    this.grabbed = { point, from: this.move.value?.by_m ?? [0, 0, 0] };
  }

  /** Go where a ray meets the plane through the point that was grabbed. */
  drag(ray: three.Ray, view: three.Vector3, isVertical: boolean): void {
    if (this.grabbed === null) return;
    const normal = isVertical ? new three.Vector3(view.x, view.y, 0).normalize() : new three.Vector3(0, 0, 1);
    const plane = new three.Plane().setFromNormalAndCoplanarPoint(normal, this.grabbed.point);
    const hit = ray.intersectPlane(plane, new three.Vector3());
    if (hit === null) return;
    const way = hit.sub(this.grabbed.point);
    const [x, y, z] = this.grabbed.from;
    this.shift(isVertical ? [x, y, round(z + way.z)] : [round(x + way.x), round(y + way.y), z]);
  }

  release(): void {
    this.grabbed = null;
  }

  shift(by_m: Vector): void {
    if (this.move.value !== null) this.move.value = { ...this.move.value, by_m };
  }

  /** Return the pose that moves what is chosen; a correction begins where it is believed to be. */
  shifts(beliefs: ReadonlyMap<string, PoseNumbers>): ReadonlyMap<string, PoseNumbers> {
    const move = this.move.value;
    if (move?.individual == null) return new Map();
    const before = move.tool === "correct" ? beliefs.get(move.individual) : undefined;
    return new Map([[move.individual, compose([...move.by_m, 1, 0, 0, 0], before ?? IDENTITY)]]);
  }

  /** Return what is to be moved where, from its true or its believed pose; null if nothing is, or that is not known. */
  describe(truth: PoseNumbers | null, belief: PoseNumbers | undefined): Displacement | null {
    const move = this.move.value;
    const from = move?.tool === "correct" ? belief : truth;
    if (move?.individual == null || from === undefined || from === null) return null;
    const { individual, label, by_m } = move;
    return { individual, label, by_m, pose: compose([...by_m, 1, 0, 0, 0], from) };
  }

  /** Do what the tool is for; return whether it was done. */
  async apply(displacement: Displacement, why: string, actions: SceneActions): Promise<boolean> {
    const isCorrection = this.move.value?.tool === "correct";
    return isCorrection ? actions.correct(displacement, why) : actions.disturb(displacement);
  }

  /** Choose nothing; the tool stays. */
  reset(): void {
    if (this.move.value !== null) this.begin(this.move.value.tool, null, undefined);
  }
}

function canMove(tool: Move["tool"], kind: string, movable: boolean): boolean {
  return tool === "disturb" ? movable : kind !== "arm" && kind !== "gripper";
}

function round(metres: number): number {
  return Math.round(metres / STEP_M) * STEP_M;
}
