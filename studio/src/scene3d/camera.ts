// Where the scene is looked at from: turned with the mouse, or one of the presets; it glides from one to the next.
import * as three from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { CameraPreset } from "./types";

const GLIDE_MS = 350;
/** What has moved less far than this, in m, is not gone after. */
const LEFT_M = 0.3;
const DIRECTIONS: Record<"front" | "side" | "top" | "fit", three.Vector3> = {
  front: new three.Vector3(0, -1, 0.12),
  side: new three.Vector3(1, 0, 0.12),
  top: new three.Vector3(0, -0.001, 1),
  fit: new three.Vector3(0.62, -0.82, 0.5),
};

interface Glide {
  from: [three.Vector3, three.Vector3];
  to: [three.Vector3, three.Vector3];
  start: number;
}

export class SceneCamera {
  readonly camera = new three.PerspectiveCamera(36, 1, 0.02, 100);
  readonly controls: OrbitControls;
  follows = false;
  /** The preset that nobody has turned away from, and the sphere it shows. */
  private kept: { preset: CameraPreset; sphere: three.Sphere } | null = null;
  private glide: Glide | null = null;
  /** The share of the height that nothing covers. */
  private free = 1;

  constructor(canvas: HTMLElement, changed: () => void) {
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.maxPolarAngle = Math.PI * 0.495;
    this.controls.minDistance = 0.1;
    this.controls.maxDistance = 30;
    this.controls.zoomToCursor = true;
    this.controls.listenToKeyEvents(canvas);
    this.controls.addEventListener("change", changed);
    this.controls.addEventListener("start", () => (this.glide = this.kept = null));
  }

  /** Set the size of the picture in pixels, `covered` of which are covered on top: its middle is that of the rest. */
  setSize(width: number, height: number, covered: number): void {
    this.free = 1 - covered / height;
    this.camera.setViewOffset(width, height, 0, -covered / 2, width, height);
  }

  /** Look at a sphere from a preset direction; at once, or gliding there. */
  look(preset: CameraPreset, sphere: three.Sphere, now: number): void {
    this.follows = preset === "follow";
    this.kept = null;
    if (preset === "follow") return;
    this.kept = { preset, sphere: sphere.clone() };
    const half = (this.camera.fov / 2) * (Math.PI / 180);
    const narrow = Math.atan(Math.tan(half) * Math.min(this.free, this.camera.aspect));
    const away = DIRECTIONS[preset].clone().normalize();
    const place = away.multiplyScalar((0.92 * sphere.radius) / Math.sin(narrow)).add(sphere.center);
    this.glide = {
      from: [this.camera.position.clone(), this.controls.target.clone()],
      to: [place, sphere.center.clone()],
      start: now,
    };
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) this.glide.start = -Infinity;
  }

  /** Go after what has left the picture, unless a person has chosen what is in it; `sphere` is around it. */
  goAfter(sphere: three.Sphere, now: number): void {
    const { kept } = this;
    if (kept === null || this.glide !== null) return;
    if (kept.sphere.center.distanceTo(sphere.center) > LEFT_M) this.look(kept.preset, sphere, now);
  }

  /** Be there at once. */
  jump(preset: CameraPreset, sphere: three.Sphere): void {
    this.look(preset, sphere, -Infinity);
    this.advance(0, null);
  }

  /** Go on with a glide, or after what is followed; return whether there is more to come. */
  advance(now: number, followed: three.Vector3 | null): boolean {
    if (this.follows && followed !== null) {
      this.camera.position.add(followed).sub(this.controls.target);
      this.controls.target.copy(followed);
      this.controls.update();
      return false;
    }
    if (this.glide === null) return false;
    const share = Math.min(1, (now - this.glide.start) / GLIDE_MS);
    const eased = share * share * (3 - 2 * share);
    this.camera.position.lerpVectors(this.glide.from[0], this.glide.to[0], eased);
    this.controls.target.lerpVectors(this.glide.from[1], this.glide.to[1], eased);
    if (share >= 1) this.glide = null;
    this.controls.update();
    return this.glide !== null;
  }

  dispose(): void {
    this.controls.dispose();
  }
}
