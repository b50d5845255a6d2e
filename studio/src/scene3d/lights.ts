// Soft light from above with one shadow, which follows what is looked at.
import * as three from "three";
import type { SceneTheme } from "./theme";

const SHADOW_PIXELS = 512;

export class SceneLights {
  readonly group = new three.Group();
  private readonly key = new three.DirectionalLight();
  private readonly sky = new three.HemisphereLight();

  constructor() {
    this.key.castShadow = true;
    this.key.shadow.mapSize.set(SHADOW_PIXELS, SHADOW_PIXELS);
    this.key.shadow.bias = -0.0005;
    this.key.shadow.normalBias = 0.01;
    this.group.add(this.sky, this.key, this.key.target);
  }

  applyTheme(theme: SceneTheme): void {
    this.sky.color.set(theme.isDark ? 0xdfe6f2 : 0xffffff);
    this.sky.groundColor.set(theme.isDark ? 0x2a2e36 : 0xb9bcc4);
    this.sky.intensity = theme.isDark ? 1.25 : 1.9;
    this.key.intensity = theme.isDark ? 1.5 : 1.6;
  }

  /** Let the shadow reach everything within a sphere. */
  cover(sphere: three.Sphere): void {
    const radius = Math.max(0.5, sphere.radius);
    this.key.target.position.copy(sphere.center);
    this.key.position.copy(sphere.center).add(new three.Vector3(0.45, -0.75, 1.5).multiplyScalar(2 * radius));
    const camera = this.key.shadow.camera;
    [camera.left, camera.right, camera.bottom, camera.top] = [-radius, radius, -radius, radius];
    [camera.near, camera.far] = [0.1, 6 * radius];
    camera.updateProjectionMatrix();
  }
}
