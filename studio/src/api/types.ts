// The types of the server under the names that the page uses.
import type { components } from "./schema";

type Schemas = components["schemas"];

// Values that events carry leave out what has its default; answers about cells, operations and plans are complete.

export type CellStatus = Required<Schemas["CellStatus"]>;
export type CellState = CellStatus["state"];
export type Checkpoint = Schemas["CellCheckpoint"];
export type OperationStatus = Required<Schemas["OperationStatus"]>;
export type OperationRequest = Partial<Schemas["OperationRequest"]>;
export type RunState = OperationStatus["state"];
export type Contact = OperationStatus["contact"];
export type Envelope = Schemas["Envelope"];
export type RunEvent = Envelope["event"];
export type Position = Schemas["Position"];
export type Failure = Schemas["Failure"];
export type FailedCallContext = Schemas["FailedCallContext"];
export type Rejection = Schemas["Rejection"];
export type ImplementationChosen = Schemas["ImplementationChosen"];
export type NodeStarted = Schemas["NodeStarted"];
export type NodeEnded = Schemas["NodeEnded"];
export type TaskStarted = Schemas["TaskStarted"];
export type TaskEnded = Schemas["TaskEnded"];
export type KnownFact = Schemas["KnownFact"];
export type PlanMade = Schemas["PlanMade"];
export type PlanStep = Schemas["PlanStep"];
export type PlanPreview = Required<Schemas["PlanPreview"]>;
export type PreviewedStep = Schemas["PreviewedStep"];
export type PreviewedBranch = Schemas["PreviewedBranch"];
export type ChosenPosture = Schemas["ChosenPosture"];
export type Prompt = Schemas["Prompt"];
export type LabelledIri = Schemas["LabelledIri"];
export type LabelledValue = Schemas["ImplementationChosen"]["bindings"][string];
export type LabelledFact = Schemas["KnownFact"]["fact"];
export type LabelledChange = Schemas["WorldChanged"]["changes"][number];
export type WorldFacts = Schemas["WorldFacts"];
export type WorldFact = Schemas["WorldFact"];
export type WorldWrite = Schemas["WorldWrite"];
export type StatableFacts = Schemas["StatableFacts"];
export type StatableTerm = Schemas["StatableTerm"];
export type LibraryDescription = Schemas["LibraryDescription"];
export type TaskDescription = Schemas["TaskDescription"];
export type ParameterDescription = Schemas["ParameterDescription"];
export type ArrivedPlan = Schemas["ArrivedPlan"];
export type DeviceStatus = Schemas["DeviceStatus"];
export type Lease = Schemas["Lease"];
export type Job = Required<Schemas["Job"]>;
export type JobRequest = Job["request"];
export type JobEvent = Schemas["JobEvent"];
export type TrialsRequest = Schemas["TrialsRequest"];
export type Series = Required<Schemas["Series"]>;
export type Spread = Required<Schemas["Spread"]>;
export type OperationTree = Schemas["OperationTree"];
export type PlannedNode = Schemas["TreeNode"];
export type RunExplanation = Schemas["RunExplanation"];
export type RunDiff = Schemas["RunDiff"];
export type SignalRows = Schemas["SignalRows"];
export type SourceText = Schemas["SourceText"];
export type LibraryStatus = Required<Schemas["LibraryStatus"]>;
/** The report of the process that controls a real arm. */
export type ControlReport = Schemas["ControlReport"];
export type ProblemDetails = Schemas["ProblemDetails"];
export type Role = Schemas["MadeToken"]["role"];

/** Who uses the page. */
export interface Session {
  name: string;
  role: Role;
}

/** A pose in the world: position in m, then the unit quaternion (w, x, y, z). */
export type PoseNumbers = [number, number, number, number, number, number, number];

/** An arm at one instant: joints in rad and rad/s; `wrench` in N and N m in the base frame of the arm, null without sensor. */
export interface ArmSample {
  joints: number[];
  speeds: number[];
  base: PoseNumbers;
  tool: PoseNumbers;
  wrench: [number, number, number, number, number, number] | null;
  /** The velocities of the tool and of its reference, in m/s; what is built of a recording has none. */
  velocity?: [number, number, number];
  commanded?: [number, number, number];
  /** The force on the tool that a push asks for now, in N; null without a push. */
  commanded_force?: [number, number, number] | null;
  /** Where the tool of a real arm is commanded to be; null while nobody commands it. */
  reference?: PoseNumbers | null;
  /** The report of the process that controls a real arm; null for others. */
  control?: ControlReport | null;
}

/** A true contact force on a tool in N, and where it acts. */
export interface ContactForce {
  force: readonly [number, number, number];
  point: readonly [number, number, number];
}

/** What moves in a cell at one instant, by IRI. `forces` are those on tools that are pressed; real cells have none. */
export interface Sample {
  cell: string;
  time_s: number;
  arms: Record<string, ArmSample>;
  things: Record<string, PoseNumbers>;
  forces?: Readonly<Record<string, ContactForce>>;
}

/** A message of the socket about cells, operations and jobs. */
export type News =
  | { type: "status"; status: CellStatus }
  | { type: "happened"; operation: OperationStatus }
  | { type: "job"; job: Job; removed: boolean };
