// What tools have worked on, painted on surfaces: the longer, the stronger.
import * as three from "three";
import { compose } from "./poses";
import { matrixOf } from "./shapes";
import type { PoseNumbers, SurfaceCoverage } from "./types";

const ABOVE_M = 0.0015;
/** After this time a cell has its full colour. */
const FULL_S = 0.6;

/** Return the bytes of a base64 text. */
export function decodeDose(text: string): Uint8Array {
  return Uint8Array.from(atob(text), (each) => each.charCodeAt(0));
}

/** Return pixels (red, green, blue, opacity), row after row, of a coverage. */
export function paintDose(coverage: SurfaceCoverage, colour: three.Color, into: Uint8Array): Uint8Array {
  const dose = decodeDose(coverage.dose);
  const [red, green, blue] = colour.toArray().map((each) => Math.round(255 * each));
  for (let index = 0; index < coverage.rows * coverage.columns; index++) {
    const seconds = (dose[index] ?? 0) * coverage.unit_s;
    const opacity = seconds === 0 ? 0 : 0.35 + 0.45 * Math.min(1, seconds / FULL_S);
    into.set([red ?? 0, green ?? 0, blue ?? 0, Math.round(255 * opacity)], 4 * index);
  }
  return into;
}

interface Painted {
  mesh: three.Mesh<three.PlaneGeometry, three.MeshBasicMaterial>;
  texture: three.DataTexture;
  dose: string;
}

export class CoverageLayer {
  readonly group = new three.Group();
  private readonly painted = new Map<string, Painted>();

  /** Paint what was worked on; return whether anything has changed. `place` has the pose of a surface. */
  update(
    coverage: Readonly<Record<string, SurfaceCoverage>>,
    colour: three.Color,
    place: (surface: string) => PoseNumbers | null,
  ): boolean {
    let changed = false;
    for (const [surface, each] of Object.entries(coverage)) {
      const pose = place(surface);
      if (pose === null) continue;
      const painted = this.painted.get(surface) ?? this.add(surface, each);
      painted.mesh.visible = each.dose !== "";
      painted.mesh.matrix.copy(matrixOf(compose(pose, [0, 0, ABOVE_M, 1, 0, 0, 0])));
      if (painted.dose === each.dose) continue;
      paintDose(each, colour, painted.texture.image.data as Uint8Array);
      painted.texture.needsUpdate = true;
      painted.dose = each.dose;
      changed = true;
    }
    return changed;
  }

  dispose(): void {
    for (const { mesh, texture } of this.painted.values()) {
      texture.dispose();
      mesh.material.dispose();
      mesh.geometry.dispose();
    }
    this.painted.clear();
    this.group.clear();
  }

  private add(surface: string, { columns, rows, size }: SurfaceCoverage): Painted {
    const texture = new three.DataTexture(new Uint8Array(4 * columns * rows), columns, rows);
    texture.magFilter = three.LinearFilter;
    const material = new three.MeshBasicMaterial({ map: texture, transparent: true, depthWrite: false });
    const mesh = new three.Mesh(new three.PlaneGeometry(...size), material);
    mesh.matrixAutoUpdate = false;
    mesh.renderOrder = 1;
    const painted = { mesh, texture, dose: "" };
    this.painted.set(surface, painted);
    this.group.add(mesh);
    return painted;
  }
}
