// The view: it takes what changes, and draws once a frame if anything has.
import { signal } from "@preact/signals";
import * as three from "three";
import { annotate } from "./annotations";
import { findOffsets, shiftsOf, type Offset } from "./offsets";
import { SceneBodies } from "./bodies";
import { SceneCamera } from "./camera";
import { CoverageLayer } from "./coverage";
import { frameThese, hasRobotLeft, projectTo, topCover } from "./framing";
import { findForces, ForceArrows, type DrawnForce } from "./forces";
import { placeBodies, poseOf } from "./kinematics";
import { LabelLayer, type Box } from "./labels";
import { Lines } from "./lines";
import { Mover } from "./mover";
import { makeOverlay, sayWhyEmpty, showControls, type Overlay } from "./overlay";
import { listen } from "./pointer";
import { sketch } from "./sketch";
import { Stage } from "./stage";
import { onThemeChange, readTheme, type SceneTheme } from "./theme";
import { START } from "./Toolbar";
import { Trails } from "./trails";
import type {
  CameraPreset,
  Displacement,
  PoseNumbers,
  SceneActions,
  SceneHandle,
  SceneOptions,
  SceneSources,
  Tool,
} from "./types";

const NO_SHIFTS: ReadonlyMap<string, PoseNumbers> = new Map();
export class SceneView implements SceneHandle {
  private readonly stage = new Stage(() => this.request());
  private readonly camera: SceneCamera;
  private readonly overlay: Overlay;
  private readonly labels: LabelLayer;
  private readonly trails = new Trails();
  private readonly arrows = new ForceArrows();
  private readonly coverage = new CoverageLayer();
  private readonly axes = new Lines(2);
  private readonly dashes = new Lines(1.5, true);
  private readonly mover = new Mover();
  private readonly options = signal<SceneOptions>(START);
  private readonly tool = signal<Tool>("select");
  private readonly follows = signal(false);
  private readonly ends: (() => void)[] = [];
  private theme: SceneTheme;
  private bodies: SceneBodies | null = null;
  private poses: PoseNumbers[] = [];
  private offsets: Offset[] = [];
  private forces: DrawnForce[] = [];
  private measured: three.Vector3[] = [];
  private covered: readonly Box[] = [];
  private frame = 0;
  private isStale = true;

  constructor(
    element: HTMLElement,
    private readonly sources: SceneSources,
    private readonly actions: SceneActions,
  ) {
    this.overlay = makeOverlay(element, this.stage.canvas);
    this.theme = readTheme(this.overlay.root);
    this.labels = new LabelLayer(this.overlay.labels);
    this.camera = new SceneCamera(this.stage.canvas, () => this.request());
    this.stage.scene.add(
      this.trails.line,
      this.arrows.group,
      this.coverage.group,
      this.axes.line,
      this.dashes.line,
    );
    this.showControls();
    this.followTheme();
    this.ends.push(
      this.overlay.onResize((width, height, covered) => {
        this.stage.setSize(width, height);
        this.covered = covered;
        this.camera.setSize(width, height, topCover(covered, height));
        this.request();
      }),
    );
    this.followSources();
    this.ends.push(listen(this.stage.canvas, this.camera.camera, this.camera.controls, this));
  }

  setCamera(preset: CameraPreset): void {
    this.camera.look(preset, this.framed(), performance.now());
    this.follows.value = this.camera.follows;
    this.request();
  }

  setOptions(options: Partial<SceneOptions>): void {
    this.options.value = { ...this.options.value, ...options };
    this.refresh();
  }

  setTool(tool: Tool): void {
    this.tool.value = tool;
    this.measured = [];
    this.overlay.root.dataset["tool"] = tool;
    this.mover.begin(tool, this.sources.model.value, this.sources.selected.value[0]);
    this.refresh();
  }

  dispose(): void {
    cancelAnimationFrame(this.frame);
    this.ends.forEach((end) => end());
    this.bodies?.dispose();
    for (const each of [this.trails, this.arrows, this.coverage, this.axes, this.dashes, this.camera])
      each.dispose();
    this.stage.dispose();
    this.overlay.dispose();
  }

  onPress(ray: three.Raycaster): boolean {
    if (this.mover.move.value === null) return false;
    const hit = this.bodies?.pick(ray);
    if (hit === undefined || hit === null || !this.mover.choose(this.sources.model.value, hit.individual))
      return false;
    this.mover.grab(hit.point);
    return true;
  }

  onDrag(ray: three.Raycaster, isVertical: boolean): void {
    this.mover.drag(ray.ray, this.camera.camera.getWorldDirection(new three.Vector3()), isVertical);
  }

  onRelease(): void {
    this.mover.release();
  }

  onClick(ray: three.Raycaster): void {
    const hit = this.bodies?.pick(ray) ?? null;
    if (this.tool.value !== "measure") return this.actions.select(hit?.individual ?? null);
    const floor = new three.Plane(new three.Vector3(0, 0, 1));
    const point = hit?.point ?? ray.ray.intersectPlane(floor, new three.Vector3());
    if (point !== null) this.measured = this.measured.length === 1 ? [...this.measured, point] : [point];
    this.refresh();
  }

  private showControls(): void {
    const { options, tool, follows, actions } = this;
    showControls(this.overlay, this, { options, tool, follows, actions }, this.mover, (act) =>
      this.applyMove(act),
    );
    this.ends.push(this.mover.move.subscribe(() => this.refresh()));
  }

  private followTheme(): void {
    const apply = (): void => {
      this.theme = readTheme(this.overlay.root);
      this.stage.applyTheme(this.theme);
      this.trails.applyTheme(this.theme);
      this.arrows.setColour(this.theme.force);
      this.rebuild();
    };
    apply();
    this.ends.push(onThemeChange(apply));
  }

  private followSources(): void {
    const { model, believed, sample, selected, coverage, paths, postures } = this.sources;
    this.ends.push(
      model.subscribe(() => {
        this.trails.clear();
        this.rebuild();
        this.camera.jump("fit", this.framed());
      }),
      sample.subscribe((now) => {
        if (now !== null) this.trails.add(now);
        this.refresh();
      }),
      ...[believed, selected, coverage, paths, postures].map((each) => each.subscribe(() => this.refresh())),
    );
  }

  /** Make the bodies of the model, as another one or other colours need other geometry. */
  private rebuild(): void {
    const model = this.sources.model.value;
    if (this.bodies !== null) this.stage.scene.remove(this.bodies.group);
    this.bodies?.dispose();
    this.coverage.dispose();
    this.bodies = model === null ? null : new SceneBodies(model, this.theme);
    if (this.bodies !== null) this.stage.scene.add(this.bodies.group);
    this.update();
    this.refresh();
  }

  private refresh(): void {
    this.isStale = true;
    this.request();
  }

  private request(): void {
    this.frame ||= requestAnimationFrame((now) => {
      this.frame = 0;
      this.draw(now);
    });
  }

  private draw(now: number): void {
    if (this.stage.isHidden) return;
    const began = performance.now();
    if (this.isStale) this.update();
    this.isStale = false;
    if (hasRobotLeft(this.sources, this.poses, this.camera.camera)) this.camera.goAfter(this.framed(), now);
    const tool = Object.values(this.sources.sample.value?.arms ?? {})[0]?.tool;
    if (this.camera.advance(now, tool === undefined ? null : new three.Vector3(tool[0], tool[1], tool[2])))
      this.request();
    const isBeside = this.options.value.reality === "beside";
    const { width, height } = this.stage;
    this.camera.setSize(width / (isBeside ? 2 : 1), height, topCover(this.covered, height));
    const [reality, belief] = [() => this.place(false), () => this.place(true)];
    const halves = isBeside
      ? [reality, belief]
      : [this.options.value.reality === "believed" ? belief : reality];
    this.stage.render(this.camera.camera, halves, began);
    this.showLabels(isBeside);
  }

  /** Compute what follows from the sources. */
  private update(): void {
    const { model, sample, believed, selected } = this.sources;
    const options = this.options.value;
    this.overlay.say(sayWhyEmpty(model.value));
    this.overlay.setHalves(options.reality === "beside");
    if (model.value === null || this.bodies === null) return;
    this.poses = placeBodies(model.value, sample.value);
    this.offsets = findOffsets(model.value, this.poses, believed.value, sample.value);
    this.forces = options.forces && sample.value !== null ? findForces(sample.value) : [];
    this.bodies.placeGhosts(this.poses, options.reality === "both" ? shiftsOf(this.offsets) : NO_SHIFTS);
    this.bodies.outlineThese(selected.value);
    this.bodies.placePlanned(this.sources.postures.value, sample.value);
    this.arrows.show(this.forces);
    this.trails.line.visible = options.trails;
    this.coverage.group.visible = options.coverage && options.reality !== "believed";
    this.coverage.update(this.sources.coverage.value, this.theme.accent, (surface) => this.poseOf(surface));
    const colour = this.tool.value === "correct" ? this.theme.believed : this.theme.disturb;
    this.bodies.placeDragged(this.poses, this.mover.shifts(shiftsOf(this.offsets)), colour);
    const [axes, dashes] = sketch(
      model.value,
      this.poses,
      this.sources,
      options.frames,
      this.measured,
      this.theme,
    );
    this.axes.show(axes);
    this.dashes.show(dashes);
  }

  private place(asBelieved: boolean): void {
    this.bodies?.place(this.poses, asBelieved ? shiftsOf(this.offsets) : NO_SHIFTS);
  }

  private poseOf(individual: string): PoseNumbers | null {
    const model = this.sources.model.value;
    return model === null ? null : poseOf(model, this.poses, individual);
  }

  private showLabels(isBeside: boolean): void {
    const [model, bodies] = [this.sources.model.value, this.bodies];
    if (model === null || bodies === null) return;
    const { poses, offsets, forces, measured } = this;
    const labels = annotate({
      model,
      bodies,
      poses,
      selected: this.sources.selected.value,
      offsets,
      forces,
      measured,
      options: this.options.value,
    });
    const width = this.stage.width / (isBeside ? 2 : 1);
    this.labels.show(
      labels,
      (at) => projectTo(this.camera.camera, width, this.stage.height, at),
      width,
      this.covered,
    );
  }

  private framed(): three.Sphere {
    const individuals = this.sources.model.value?.individuals ?? {};
    return frameThese(this.bodies, individuals, this.poses, this.sources.selected.value);
  }

  private async applyMove(act: (displacement: Displacement) => Promise<boolean>): Promise<void> {
    const individual = this.mover.move.value?.individual ?? "";
    const displacement = this.mover.describe(
      this.poseOf(individual),
      this.sources.believed.value[individual],
    );
    if (displacement !== null && (await act(displacement))) this.mover.reset();
  }
}
