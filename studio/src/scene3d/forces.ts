// Contact forces as arrows: each begins where the force acts on the tool, and is 1 cm long for each newton.
import * as three from "three";
import { compose } from "./poses";
import type { PoseNumbers, Sample, Vector } from "./types";

const M_PER_N = 0.01;
const CAPACITY = 16;
/** A wrench that a sensor measures is drawn from this force on; weaker ones are noise. */
const FEWEST_MEASURED_N = 2;

/** A force to draw: in N, where it acts, and what it says. */
export interface DrawnForce {
  force: Vector;
  point: Vector;
  text: string;
  tip: Vector;
}

/** Return the true contact forces of a sample; if it has none, what sensors at wrists measure. */
export function findForces(sample: Sample): DrawnForce[] {
  const contacts = Object.values(sample.forces ?? {});
  if (contacts.length > 0) return contacts.map(({ force, point }) => describe(force, point, ""));
  return Object.values(sample.arms).flatMap(({ wrench, base, tool }) => {
    if (wrench === null || Math.hypot(wrench[0], wrench[1], wrench[2]) < FEWEST_MEASURED_N) return [];
    const turn: PoseNumbers = [0, 0, 0, base[3], base[4], base[5], base[6]];
    const [x, y, z] = compose(turn, [wrench[0], wrench[1], wrench[2], 1, 0, 0, 0]);
    return [describe([x, y, z], [tool[0], tool[1], tool[2]], " measured")];
  });
}

function describe(force: Vector, point: Vector, suffix: string): DrawnForce {
  const tip: Vector = [
    point[0] + force[0] * M_PER_N,
    point[1] + force[1] * M_PER_N,
    point[2] + force[2] * M_PER_N,
  ];
  return { force, point, tip, text: `${Math.hypot(...force).toFixed(1)} N${suffix}` };
}

/** Draws arrows in two calls: shafts, which are stretched, and heads, which are not. */
export class ForceArrows {
  readonly group = new three.Group();
  private readonly shafts: three.InstancedMesh;
  private readonly heads: three.InstancedMesh;
  private readonly material = new three.MeshBasicMaterial({
    depthTest: false,
    transparent: true,
    opacity: 0.95,
  });

  constructor() {
    const shaft = new three.CylinderGeometry(0.005, 0.005, 1, 12).translate(0, 0.5, 0);
    const head = new three.ConeGeometry(0.014, 0.035, 16).translate(0, 0.0175, 0);
    this.shafts = new three.InstancedMesh(shaft, this.material, CAPACITY);
    this.heads = new three.InstancedMesh(head, this.material, CAPACITY);
    for (const each of [this.shafts, this.heads]) {
      each.frustumCulled = false;
      each.renderOrder = 3;
      this.group.add(each);
    }
    this.show([]);
  }

  setColour(colour: three.Color): void {
    this.material.color.copy(colour);
  }

  show(forces: readonly DrawnForce[]): void {
    const shown = forces.slice(0, CAPACITY);
    shown.forEach(({ force, point, tip }, index) => {
      const length = Math.hypot(...force) * M_PER_N;
      const turn = new three.Quaternion().setFromUnitVectors(UP, new three.Vector3(...force).normalize());
      const [start, end] = [new three.Vector3(...point), new three.Vector3(...tip)];
      this.shafts.setMatrixAt(
        index,
        new three.Matrix4().compose(start, turn, new three.Vector3(1, length, 1)),
      );
      this.heads.setMatrixAt(index, new three.Matrix4().compose(end, turn, ONE));
    });
    for (const each of [this.shafts, this.heads]) {
      each.count = shown.length;
      each.visible = shown.length > 0;
      each.instanceMatrix.needsUpdate = true;
    }
  }

  dispose(): void {
    this.shafts.geometry.dispose();
    this.heads.geometry.dispose();
    this.material.dispose();
  }
}

const UP = new three.Vector3(0, 1, 0);
const ONE = new three.Vector3(1, 1, 1);
