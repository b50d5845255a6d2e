// Soft light from above; what it does not reach is dark on the floor.
import * as three from "three";
import type { SceneTheme } from "./theme";

/** Where the light comes from. */
export const LIGHT = new three.Vector3(0.45, -0.75, 1.5);

export class SceneLights {
  readonly group = new three.Group();
  private readonly key = new three.DirectionalLight();
  private readonly sky = new three.HemisphereLight();

  constructor() {
    this.key.position.copy(LIGHT);
    this.group.add(this.sky, this.key);
  }

  applyTheme(theme: SceneTheme): void {
    this.sky.color.set(theme.isDark ? 0xdfe6f2 : 0xffffff);
    this.sky.groundColor.set(theme.isDark ? 0x2a2e36 : 0xb9bcc4);
    this.sky.intensity = theme.isDark ? 1.25 : 1.9;
    this.key.intensity = theme.isDark ? 1.5 : 1.6;
  }
}
