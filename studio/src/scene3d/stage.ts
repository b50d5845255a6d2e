// The canvas: it draws a scene once, or twice side by side, and keeps count of what that costs.
import * as three from "three";
import { makeFloor } from "./floor";
import { SceneLights } from "./lights";
import { Quality } from "./quality";
import type { SceneTheme } from "./theme";
import type { SceneStatistics } from "./types";

const KEPT_TIMES = 200;
/** So long after the last change everything is drawn with all pixels. */
const SETTLED_MS = 250;

export class Stage {
  readonly scene = new three.Scene();
  readonly canvas: HTMLCanvasElement;
  readonly lights = new SceneLights();
  width = 1;
  height = 1;
  private readonly renderer: three.WebGLRenderer;
  private readonly quality = new Quality();
  private floor: three.Mesh | null = null;
  private frames = 0;
  private scriptMs: number[] = [];
  private scale = 0;
  private settling = 0;

  /** Make a canvas; Error if the browser has no WebGL. */
  constructor(private readonly changed: () => void) {
    this.renderer = new three.WebGLRenderer({ antialias: true, powerPreference: "low-power" });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = three.PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.renderer.info.autoReset = false;
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute(
      "aria-label",
      "The cell in three dimensions; arrow keys pan, with Shift they turn",
    );
    this.canvas.addEventListener("webglcontextrestored", changed);
    this.scene.add(this.lights.group);
  }

  applyTheme(theme: SceneTheme): void {
    this.renderer.setClearColor(theme.ground);
    this.lights.applyTheme(theme);
    this.releaseFloor();
    this.floor = makeFloor(theme);
    this.scene.add(this.floor);
  }

  setSize(width: number, height: number): void {
    [this.width, this.height] = [Math.max(1, width), Math.max(1, height)];
    this.applyScale(window.devicePixelRatio);
  }

  /** Let shadows follow what has moved. */
  moveShadows(): void {
    this.renderer.shadowMap.needsUpdate = true;
  }

  /** Draw the scene once for each of one or two halves; each is prepared before. `began` is when the work on it began. */
  render(camera: three.PerspectiveCamera, halves: readonly (() => void)[], began: number): void {
    const width = this.width / halves.length;
    this.renderer.info.reset();
    this.renderer.setScissorTest(halves.length > 1);
    halves.forEach((prepare, index) => {
      prepare();
      this.renderer.setViewport(index * width, 0, width, this.height);
      this.renderer.setScissor(index * width, 0, width, this.height);
      this.renderer.render(this.scene, camera);
    });
    this.frames++;
    this.scriptMs.push(performance.now() - began);
    if (this.scriptMs.length > KEPT_TIMES) this.scriptMs.shift();
    this.watchLoad();
  }

  statistics(): SceneStatistics {
    const { calls, triangles } = this.renderer.info.render;
    return { frames: this.frames, drawCalls: calls, triangles, scriptMs: [...this.scriptMs] };
  }

  dispose(): void {
    window.clearTimeout(this.settling);
    this.releaseFloor();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.canvas.remove();
  }

  /** Look how long the browser is busy with a frame, and draw the next ones accordingly. */
  private watchLoad(): void {
    const drawn = performance.now();
    requestAnimationFrame(() => {
      if (this.quality.note(performance.now() - drawn))
        this.applyScale(window.devicePixelRatio * this.quality.scale);
    });
    window.clearTimeout(this.settling);
    if (this.scale === window.devicePixelRatio && this.quality.scale === 1) return;
    this.settling = window.setTimeout(() => {
      if (this.scale === window.devicePixelRatio) return;
      this.applyScale(window.devicePixelRatio);
      this.changed();
    }, SETTLED_MS);
  }

  private applyScale(scale: number): void {
    this.scale = scale;
    this.renderer.setPixelRatio(scale);
    this.renderer.setSize(this.width, this.height, false);
  }

  private releaseFloor(): void {
    if (this.floor === null) return;
    this.scene.remove(this.floor);
    this.floor.geometry.dispose();
    (this.floor.material as three.Material).dispose();
  }
}
