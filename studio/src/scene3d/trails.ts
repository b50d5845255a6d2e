// The ways of tools: lines of the last minutes, with another colour where the tool was pressed on something.
import * as three from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import type { SceneTheme } from "./theme";
import type { Sample, Vector } from "./types";

const CAPACITY = 3000;
const SHORTEST_M = 0.002;
/** A tool that is further away in the next sample has jumped there. */
const LONGEST_M = 0.25;

/** Draws the trails of all arms in one call; segments are written one after the other, the oldest are overwritten. */
export class Trails {
  readonly line: LineSegments2;
  private readonly points = new three.InstancedInterleavedBuffer(new Float32Array(CAPACITY * 6), 6, 1);
  private readonly colours = new three.InstancedInterleavedBuffer(new Float32Array(CAPACITY * 6), 6, 1);
  private readonly last = new Map<string, Vector>();
  private next = 0;
  private time = -Infinity;
  private free = new three.Color();
  private pressed = new three.Color();

  constructor() {
    const geometry = new LineSegmentsGeometry();
    const part = (buffer: three.InterleavedBuffer, offset: number) =>
      new three.InterleavedBufferAttribute(buffer, 3, offset);
    geometry.setAttribute("instanceStart", part(this.points, 0));
    geometry.setAttribute("instanceEnd", part(this.points, 3));
    geometry.setAttribute("instanceColorStart", part(this.colours, 0));
    geometry.setAttribute("instanceColorEnd", part(this.colours, 3));
    geometry.instanceCount = 0;
    this.line = new LineSegments2(geometry, new LineMaterial({ linewidth: 2, vertexColors: true }));
    this.line.frustumCulled = false;
  }

  applyTheme(theme: SceneTheme): void {
    this.free = theme.trail;
    this.pressed = theme.force;
  }

  /** Add where the tools are now; a sample that is older than the last one begins anew. */
  add(sample: Sample): void {
    if (sample.time_s < this.time) this.clear();
    this.time = sample.time_s;
    const colour = Object.keys(sample.forces ?? {}).length > 0 ? this.pressed : this.free;
    for (const [arm, { tool }] of Object.entries(sample.arms)) {
      const [before, now]: [Vector | undefined, Vector] = [this.last.get(arm), [tool[0], tool[1], tool[2]]];
      const way =
        before === undefined ? Infinity : Math.hypot(...now.map((each, axis) => each - (before[axis] ?? 0)));
      if (way < SHORTEST_M) continue;
      this.last.set(arm, now);
      if (before !== undefined && way < LONGEST_M) this.write(before, now, colour);
    }
  }

  clear(): void {
    this.last.clear();
    this.next = 0;
    this.line.geometry.instanceCount = 0;
  }

  dispose(): void {
    this.line.geometry.dispose();
    this.line.material.dispose();
  }

  private write(from: Vector, to: Vector, { r, g, b }: three.Color): void {
    const at = (this.next % CAPACITY) * 6;
    this.points.array.set([...from, ...to], at);
    this.colours.array.set([r, g, b, r, g, b], at);
    for (const buffer of [this.points, this.colours]) {
      buffer.addUpdateRange(at, 6);
      buffer.needsUpdate = true;
    }
    this.next++;
    this.line.geometry.instanceCount = Math.min(this.next, CAPACITY);
  }
}
