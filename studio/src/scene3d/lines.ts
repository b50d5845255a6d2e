// Lines that are written anew whenever they change: frames, planned paths, what is measured, and where belief is wrong.
import * as three from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { transform } from "./poses";
import type { PoseNumbers, Vector } from "./types";

/** A line from one point to another. */
export interface Segment {
  from: Vector;
  to: Vector;
  colour: three.Color;
}

const [X, Y, Z] = [
  new three.Color(0.75, 0.05, 0.05),
  new three.Color(0.03, 0.42, 0.1),
  new three.Color(0.08, 0.2, 0.8),
];

/** Return the axes of a frame, x red, y green, z blue. */
export function axesOf(pose: PoseNumbers, length: number): Segment[] {
  const from: Vector = [pose[0], pose[1], pose[2]];
  return [
    { from, to: transform(pose, [length, 0, 0]), colour: X },
    { from, to: transform(pose, [0, length, 0]), colour: Y },
    { from, to: transform(pose, [0, 0, length]), colour: Z },
  ];
}

/** Return the segments of a path. */
export function pathOf(points: readonly Vector[], colour: three.Color): Segment[] {
  return points.slice(1).map((to, index) => ({ from: points[index] ?? to, to, colour }));
}

/** Draws segments in one call, over everything else. */
export class Lines {
  readonly line: LineSegments2;

  constructor(width: number, dashed = false) {
    const style = dashed ? { dashed: true, dashSize: 0.02, gapSize: 0.012 } : {};
    const material = new LineMaterial({
      linewidth: width,
      vertexColors: true,
      depthTest: false,
      transparent: true,
      ...style,
    });
    this.line = new LineSegments2(new LineSegmentsGeometry(), material);
    this.line.frustumCulled = false;
    this.line.renderOrder = 2;
    this.show([]);
  }

  show(segments: readonly Segment[]): void {
    this.line.visible = segments.length > 0;
    if (segments.length === 0) return;
    this.line.geometry.dispose();
    this.line.geometry = new LineSegmentsGeometry();
    this.line.geometry.setPositions(segments.flatMap(({ from, to }) => [...from, ...to]));
    this.line.geometry.setColors(segments.flatMap(({ colour: { r, g, b } }) => [r, g, b, r, g, b]));
    if (this.line.material.dashed) this.line.computeLineDistances();
  }

  dispose(): void {
    this.line.geometry.dispose();
    this.line.material.dispose();
  }
}
