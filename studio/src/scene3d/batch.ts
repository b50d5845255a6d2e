// All bodies of a cell in one draw call: each is an instance with its own matrix.
import * as three from "three";
import { matrixOf } from "./shapes";
import type { PoseNumbers } from "./types";

/** Draws bodies with one material; `geometries` are by the number of the body. */
export class BodyBatch {
  readonly mesh: three.BatchedMesh;
  private readonly instances = new Map<number, number>();
  private readonly bodies: number[] = [];
  private readonly matrix = new three.Matrix4();

  constructor(
    geometries: ReadonlyMap<number, three.BufferGeometry>,
    private readonly material: three.Material,
  ) {
    const all = [...geometries.values()];
    const points = all.reduce((sum, each) => sum + each.getAttribute("position").count, 0);
    const corners = all.reduce((sum, each) => sum + (each.index?.count ?? 0), 0);
    this.mesh = new three.BatchedMesh(
      Math.max(1, all.length),
      Math.max(1, points),
      Math.max(1, corners),
      material,
    );
    this.mesh.sortObjects = false;
    this.mesh.frustumCulled = false;
    for (const [body, geometry] of geometries) {
      const instance = this.mesh.addInstance(this.mesh.addGeometry(geometry));
      this.instances.set(body, instance);
      this.bodies[instance] = body;
    }
  }

  /** Put a body at a pose. */
  place(body: number, pose: PoseNumbers): void {
    const instance = this.instances.get(body);
    if (instance !== undefined) this.mesh.setMatrixAt(instance, matrixOf(pose, this.matrix));
  }

  /** Show bodies, and no others. */
  show(bodies: ReadonlySet<number>): void {
    for (const [body, instance] of this.instances) this.mesh.setVisibleAt(instance, bodies.has(body));
    this.mesh.visible = [...bodies].some((body) => this.instances.has(body));
  }

  /** Return the number of the body that a ray has hit. */
  bodyOf(hit: three.Intersection): number {
    return this.bodies[hit.batchId ?? -1] ?? -1;
  }

  dispose(): void {
    this.mesh.dispose();
    this.material.dispose();
  }
}
