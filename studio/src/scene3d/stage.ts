// The canvas: it draws a scene once, or twice side by side, and says what that costs.
import * as three from "three";
import { makeFloor } from "./floor";
import { SceneLights } from "./lights";
import { Quality } from "./quality";
import type { SceneTheme } from "./theme";

/** The name of the entries of the performance timeline that say what each frame costs. */
const DRAWN = "scene drawn";
/** So long after the last change everything is drawn as well as can be. */
const SETTLED_MS = 250;

export class Stage {
  readonly scene = new three.Scene();
  readonly canvas: HTMLCanvasElement;
  private readonly lights = new SceneLights();
  width = 1;
  height = 1;
  /** Whether nothing of the canvas is in sight, as while another panel is enlarged. */
  isHidden = false;
  private readonly renderer: three.WebGLRenderer;
  private readonly quality = new Quality();
  private floor: ReturnType<typeof makeFloor> | null = null;
  private settling = 0;
  private hasSettled = false;

  /** Make a canvas; Error if the browser has no WebGL. */
  constructor(private readonly changed: () => void) {
    this.renderer = new three.WebGLRenderer({
      antialias: !this.quality.isSoftware,
      powerPreference: "low-power",
    });
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
    this.floor.material.opacity = this.renderer.getPixelRatio();
    this.scene.add(this.floor);
  }

  setSize(width: number, height: number): void {
    this.isHidden = width === 0 || height === 0;
    [this.width, this.height] = [Math.max(1, width), Math.max(1, height)];
    this.renderer.setSize(this.width, this.height, false);
  }

  /** Draw the scene once for each of one or two halves; each is prepared before. `began` is when the work on it began. */
  render(camera: three.PerspectiveCamera, halves: readonly (() => void)[], began: number): void {
    const width = this.width / halves.length;
    const isSharp = this.hasSettled;
    this.hasSettled = false;
    this.applyScale(this.quality.scale(isSharp, this.width * this.height));
    this.renderer.info.reset();
    this.renderer.setScissorTest(halves.length > 1);
    halves.forEach((prepare, index) => {
      prepare();
      this.renderer.setViewport(index * width, 0, width, this.height);
      this.renderer.setScissor(index * width, 0, width, this.height);
      this.renderer.render(this.scene, camera);
    });
    this.report(began);
    this.watchLoad(isSharp);
  }

  dispose(): void {
    window.clearTimeout(this.settling);
    this.releaseFloor();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.canvas.remove();
  }

  /** Tell observers of the performance timeline of a frame: its script, and what is drawn; the browser keeps nothing. */
  private report(began: number): void {
    const { calls, triangles } = this.renderer.info.render;
    performance.measure(DRAWN, { start: began, detail: { calls, triangles } });
    performance.clearMeasures(DRAWN);
  }

  /** Look how long the browser is busy with a frame, to draw the next ones accordingly; draw it well if it stays. */
  private watchLoad(isSharp: boolean): void {
    const drawn = performance.now();
    requestAnimationFrame(() => this.quality.note(performance.now() - drawn));
    window.clearTimeout(this.settling);
    if (isSharp) return;
    this.settling = window.setTimeout(() => {
      this.hasSettled = true;
      this.changed();
    }, SETTLED_MS);
  }

  private applyScale(scale: number): void {
    if (this.renderer.getPixelRatio() === scale) return;
    this.renderer.setPixelRatio(scale);
    // Lines of the floor are one pixel wide, whatever its size.
    if (this.floor !== null) this.floor.material.opacity = scale;
  }

  private releaseFloor(): void {
    if (this.floor === null) return;
    this.scene.remove(this.floor);
    this.floor.geometry.dispose();
    this.floor.material.dispose();
  }
}
