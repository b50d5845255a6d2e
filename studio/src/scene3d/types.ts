// What the 3-D view takes: the model of a cell, what moves, what is believed, and what is selected. SI units, world frame.
import type { PoseNumbers as Numbers, Sample as ApiSample } from "../api/types";

export type Vector = readonly [number, number, number];
export type PoseNumbers = Readonly<Numbers>;

/** A sample of a cell; `joints` has the values of joints that are no arm's by name.
 *  One of a recording has the poses of all bodies that move in the world, by their names, instead of joints. */
export interface Sample extends ApiSample {
  joints?: Readonly<Record<string, number>>;
  bodies?: Readonly<Record<string, PoseNumbers>>;
}

export type Shape = "plane" | "sphere" | "capsule" | "ellipsoid" | "cylinder" | "box" | "mesh";

/** A shape in the frame of its body; `size` as in MuJoCo: half extents, or radius and half length along z. */
export interface Geom {
  shape: Shape;
  size: Vector;
  pose: PoseNumbers;
  colour: readonly [number, number, number, number];
  /** The number of the mesh; null for other shapes. */
  mesh: number | null;
}

/** Points (n, 3) in m one after the other, and triangles (m, 3) of their numbers. */
export interface Mesh {
  points: readonly number[];
  triangles: readonly number[];
}

/** A joint of a body: its axis and the point that it turns about in the frame of the body, and its value at rest. */
export interface Joint {
  name: string;
  kind: "hinge" | "slide" | "ball" | "free";
  axis: Vector;
  anchor: Vector;
  rest: number;
}

/** A body, after its parent; `pose` is that in the parent with all joints at rest, -1 stands for the world. */
export interface Body {
  name: string;
  parent: number;
  pose: PoseNumbers;
  joints: readonly Joint[];
  geoms: readonly Geom[];
  /** The IRI of the individual whose part the body is; null for the floor. */
  individual: string | null;
}

/** An individual, whose own frame is at the pose `frame` in a body. */
export interface ModelIndividual {
  label: string;
  body: number;
  frame: PoseNumbers;
  kind: "arm" | "gripper" | "base" | "tool" | "surface" | "fixture" | "body";
  /** Whether a disturbance can move it in the simulated reality. */
  movable: boolean;
}

/** An arm: its joints in the order of samples, which have the frame of its individual as `base`. */
export interface ModelArm {
  joints: readonly string[];
}

/** What `GET /cells/{cell}/model` answers: the geometry of a cell as it really is, in a simulation. */
export interface CellModel {
  bodies: readonly Body[];
  meshes: readonly Mesh[];
  individuals: Readonly<Record<string, ModelIndividual>>;
  arms: Readonly<Record<string, ModelArm>>;
}

/** Where the world model has individuals, by IRI. */
export type BelievedPoses = Readonly<Record<string, PoseNumbers>>;

/** How long each cell of a surface was worked on: bytes in base64, first along x, in units of `unit_s`; empty for none. */
export interface SurfaceCoverage {
  size: readonly [number, number];
  columns: number;
  rows: number;
  unit_s: number;
  dose: string;
}

/** A path that a tool is going to take, as points in the world. */
export type PlannedPath = readonly Vector[];

/** The joints, in rad, with which an arm is to bring its tool to a pose; without `base` it stands where it is. */
export interface PlannedPosture {
  arm: string;
  joints: readonly number[];
  base: PoseNumbers | null;
  tool: PoseNumbers;
}

/** A value that changes; the signals of Preact are such. */
export interface Source<T> {
  readonly value: T;
  subscribe(listener: (value: T) => void): () => void;
}

export interface SceneSources {
  model: Source<CellModel | null>;
  believed: Source<BelievedPoses>;
  sample: Source<Sample | null>;
  /** The IRIs of what is selected. */
  selected: Source<readonly string[]>;
  coverage: Source<Readonly<Record<string, SurfaceCoverage>>>;
  paths: Source<readonly PlannedPath[]>;
  /** The postures of the step of a plan that is chosen, in order. */
  postures: Source<readonly PlannedPosture[]>;
}

/** A thing that was moved with the mouse, by (x, y, z) in m. */
export interface Displacement {
  individual: string;
  label: string;
  by_m: Vector;
  /** Where it is then. */
  pose: PoseNumbers;
}

/** The tools that move a thing. */
export type MovingTool = "disturb" | "correct";

/** What a person does in the view. */
export interface SceneActions {
  /** Whether the cell is one of real devices, where nothing is simulated. */
  isReal: Source<boolean>;
  select(individual: string | null): void;
  /** Why each tool moves nothing now, as a sentence; empty where it may. */
  refusals: Source<Readonly<Record<MovingTool, string>>>;
  /** Move a thing in the simulated reality; what the cell knows stays as it is. */
  disturb(displacement: Displacement): Promise<boolean>;
  /** Take a thing out of the hand that holds it in the simulated reality, and put it there. */
  take(displacement: Displacement): Promise<boolean>;
  /** Move a thing in the world model, with a reason; reality stays as it is. */
  correct(displacement: Displacement, why: string): Promise<boolean>;
}

export type CameraPreset = "front" | "side" | "top" | "follow" | "fit";
/** What is drawn: what is true, what is believed, one as a ghost over the other, or both side by side. */
export type Reality = "both" | "true" | "believed" | "beside";
export type Tool = "select" | "measure" | MovingTool;

/** What is shown. */
export interface SceneOptions {
  reality: Reality;
  labels: boolean;
  frames: boolean;
  trails: boolean;
  forces: boolean;
  coverage: boolean;
}

export interface SceneHandle {
  setCamera(preset: CameraPreset): void;
  setOptions(options: Partial<SceneOptions>): void;
  setTool(tool: Tool): void;
  /** Take the view out of the page and release its memory. */
  dispose(): void;
}
