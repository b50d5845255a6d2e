// Made from the endpoints of the contract by `python tests/accept.py`; do not edit.
import type { components } from "./schema";

type Schemas = components["schemas"];

/** What the request of a name has in its path, its query and its body, and what is answered. */
export interface Requests {
  /** List the cells. */
  list_cells: {
    path: [];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["CellStatus"]>[];
  };
  /** Show a cell. */
  show_cell: {
    path: [cell: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["CellStatus"]>;
  };
  /** Set the pace of a cell. */
  set_pace: {
    path: [cell: string];
    query: Record<string, never>;
    body: Schemas["PaceSetting"];
    answer: Required<Schemas["CellStatus"]>;
  };
  /** Let a cell take operations again after a fault or a stop whose cause is removed. */
  acknowledge_fault: {
    path: [cell: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["CellStatus"]>;
  };
  /** Stop all operations of a cell. */
  stop_cell: {
    path: [cell: string];
    query: Record<string, never>;
    body: Schemas["StopReason"];
    answer: Required<Schemas["CellStatus"]>;
  };
  /** Reset a simulated cell to its scene: its world and its reality. */
  reset_cell: {
    path: [cell: string];
    query: Record<string, never>;
    body: Schemas["ResetReason"];
    answer: Required<Schemas["CellStatus"]>;
  };
  /** List the checkpoints of a simulated cell, by name. */
  list_checkpoints: {
    path: [cell: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["CellCheckpoint"]>[];
  };
  /** Save a simulated cell, its world and its reality, as a checkpoint. */
  save_cell: {
    path: [cell: string];
    query: Record<string, never>;
    body: Schemas["CheckpointName"];
    answer: Required<Schemas["CellCheckpoint"]>;
  };
  /** Restore a simulated cell from a checkpoint. */
  restore_cell: {
    path: [cell: string, checkpoint: string];
    query: Record<string, never>;
    body: Schemas["ResetReason"];
    answer: Required<Schemas["CellStatus"]>;
  };
  /** Remove a checkpoint of a simulated cell. */
  remove_checkpoint: {
    path: [cell: string, checkpoint: string];
    query: Record<string, never>;
    body: undefined;
    answer: undefined;
  };
  /** Let something happen to a simulated cell that no skill does. */
  disturb_cell: {
    path: [cell: string];
    query: Record<string, never>;
    body: Schemas["PushArm"] | Schemas["MoveThing"] | Schemas["TakeThing"] | Schemas["PressEmergencyStop"] | Schemas["LoseArm"];
    answer: Required<Schemas["CellStatus"]>;
  };
  /** Show the shapes and joints of a simulated cell, as they really are. */
  show_model: {
    path: [cell: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["CellModel"]>;
  };
  /** List where the world of a cell has individuals, by IRI. */
  list_poses: {
    path: [cell: string];
    query: Record<string, never>;
    body: undefined;
    answer: Record<string, [number, number, number, number, number, number, number]>;
  };
  /** Show where tools have really worked on surfaces. */
  show_coverage: {
    path: [cell: string];
    query: Record<string, never>;
    body: undefined;
    answer: Record<string, Required<Schemas["SurfaceCoverage"]>>;
  };
  /** Show who has the lease of a cell. */
  show_lease: {
    path: [cell: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["Lease"]>;
  };
  /** Take the lease of a cell, or prolong it. */
  take_lease: {
    path: [cell: string];
    query: Record<string, never>;
    body: Schemas["LeaseRequest"];
    answer: Required<Schemas["Lease"]>;
  };
  /** Give the lease of a cell back. */
  release_lease: {
    path: [cell: string];
    query: Record<string, never>;
    body: undefined;
    answer: undefined;
  };
  /** List the operations of a cell, the last one first. */
  list_operations: {
    path: [cell: string];
    query: { before_ns?: number | null; limit?: number; search?: string; ongoing?: boolean };
    body: undefined;
    answer: Required<Schemas["OperationStatus"]>[];
  };
  /** Submit an operation. */
  submit_operation: {
    path: [cell: string];
    query: Record<string, never>;
    body: Schemas["OperationRequest"];
    answer: Required<Schemas["OperationStatus"]>;
  };
  /** Show an operation. */
  show_operation: {
    path: [operation: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["OperationStatus"]>;
  };
  /** Give a command to an operation. */
  give_command: {
    path: [operation: string];
    query: Record<string, never>;
    body: Schemas["Approve"] | Schemas["PauseRun"] | Schemas["Resume"] | Schemas["StepInto"] | Schemas["StepOver"] | Schemas["StepOut"] | Schemas["RetryStep"] | Schemas["Skip"] | Schemas["Replan"] | Schemas["AnswerPrompt"] | Schemas["SetBreakpoints"];
    answer: Required<Schemas["OperationStatus"]>;
  };
  /** Stop an operation; nothing happens if it has ended. */
  stop_operation: {
    path: [operation: string];
    query: Record<string, never>;
    body: Schemas["StopReason"];
    answer: Required<Schemas["OperationStatus"]>;
  };
  /** Read the events of an operation. */
  list_events: {
    path: [operation: string];
    query: { after?: number; limit?: number };
    body: undefined;
    answer: Required<Schemas["Envelope"]>[];
  };
  /** Order an operation at a time, or again and again. */
  add_order: {
    path: [cell: string];
    query: Record<string, never>;
    body: Schemas["OrderRequest"];
    answer: Required<Schemas["Order"]>;
  };
  /** List the orders for a cell. */
  list_orders: {
    path: [cell: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["Order"]>[];
  };
  /** Remove an order; what it has submitted goes on. */
  remove_order: {
    path: [order: string];
    query: Record<string, never>;
    body: undefined;
    answer: undefined;
  };
  /** List the operations that wait in a cell, in the order in which they get planners and devices. */
  list_queue: {
    path: [cell: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["OperationStatus"]>[];
  };
  /** Put operations before all others that wait in a cell, whatever their priority. */
  reorder_queue: {
    path: [cell: string];
    query: Record<string, never>;
    body: Schemas["QueueOrder"];
    answer: Required<Schemas["OperationStatus"]>[];
  };
  /** Read the recording of an operation, an MCAP file, as far as it is written. */
  read_recording: {
    path: [operation: string];
    query: Record<string, never>;
    body: undefined;
    answer: ArrayBuffer;
  };
  /** Show the tree of an operation, with the numbers that events have. */
  show_tree: {
    path: [operation: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["OperationTree"]>;
  };
  /** Explain what an operation has chosen, how it ended, and why. */
  explain_run: {
    path: [operation: string];
    query: { question?: string };
    body: undefined;
    answer: Required<Schemas["RunExplanation"]>;
  };
  /** Read recorded signals of an operation, at most 5000 rows at once. */
  read_signals: {
    path: [operation: string];
    query: { match?: string; after_s?: number; until_s?: number; every_s?: number };
    body: undefined;
    answer: Required<Schemas["SignalRows"]>;
  };
  /** Compare an operation with another one. */
  compare_runs: {
    path: [operation: string];
    query: { other: string };
    body: undefined;
    answer: Required<Schemas["RunDiff"]>;
  };
  /** List facts of the world of a cell. */
  list_facts: {
    path: [cell: string];
    query: { subject?: string | null; type?: string | null; search?: string | null; offset?: number; limit?: number };
    body: undefined;
    answer: Required<Schemas["WorldFacts"]>;
  };
  /** Write the world of a cell as RDF or as a picture. */
  write_world: {
    path: [cell: string];
    query: { format?: "turtle" | "rdfxml" | "jsonld" | "ntriples" | "trig" | "graph" | "top-view"; everything?: boolean };
    body: undefined;
    answer: Required<Schemas["WorldText"]>;
  };
  /** List the relations and properties that facts about a thing may have. */
  list_terms: {
    path: [cell: string];
    query: { subject: string };
    body: undefined;
    answer: Required<Schemas["StatableFacts"]>;
  };
  /** List what has a place or a size in a cell, as it is believed. */
  list_things: {
    path: [cell: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["PlacedThing"]>[];
  };
  /** Answer a SPARQL query about the world of a cell. */
  query_world: {
    path: [cell: string];
    query: Record<string, never>;
    body: Schemas["WorldQuery"];
    answer: Required<Schemas["QueryRows"]>;
  };
  /** Change the world of a cell in one transaction. */
  edit_world: {
    path: [cell: string];
    query: Record<string, never>;
    body: Schemas["WorldEdit"];
    answer: undefined;
  };
  /** Say where a thing is in the world of a cell; nothing moves. */
  place_thing: {
    path: [cell: string];
    query: Record<string, never>;
    body: Schemas["WorldPlacement"];
    answer: undefined;
  };
  /** List who has written what to the world of a cell, and when. */
  list_writes: {
    path: [cell: string];
    query: { before?: number | null; limit?: number };
    body: undefined;
    answer: Required<Schemas["WorldWrite"]>[];
  };
  /** Show the versions of skillc and of the API. */
  show_version: {
    path: [];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["VersionInfo"]>;
  };
  /** List the libraries, and why the one on disk is not used. */
  list_libraries: {
    path: [];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["LibraryStatus"]>[];
  };
  /** Describe the library of a cell. */
  show_library: {
    path: [cell: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["LibraryDescription"]>;
  };
  /** List the devices of a cell, and which operation holds each. */
  list_robots: {
    path: [cell: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["DeviceStatus"]>[];
  };
  /** Begin work for a cell: `plan`, `rehearsal`, `trials`, `trial-replay` or `report`; all but a plan need `operate`. */
  add_job: {
    path: [];
    query: Record<string, never>;
    body: Schemas["PlanRequest"] | Schemas["RehearsalRequest"] | Schemas["TrialsRequest"] | Schemas["TrialReplayRequest"] | Schemas["ReportRequest"] | Schemas["LearnRequest"];
    answer: Required<Schemas["Job"]>;
  };
  /** List the jobs of all cells, or of one. */
  list_jobs: {
    path: [];
    query: { cell?: string | null };
    body: undefined;
    answer: Required<Schemas["Job"]>[];
  };
  /** Show a job. */
  show_job: {
    path: [job: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["Job"]>;
  };
  /** Show what came of a job; of trials also while they go on. */
  show_job_result: {
    path: [job: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["JobResult"]>;
  };
  /** Read the log of a job, or wait for its next line. */
  list_job_events: {
    path: [job: string];
    query: { after?: number; wait_s?: number };
    body: undefined;
    answer: Required<Schemas["JobEvent"]>[];
  };
  /** Read a file that a job has left: a recording, a film, a report, a picture. */
  read_job_file: {
    path: [job: string, file: string];
    query: Record<string, never>;
    body: undefined;
    answer: ArrayBuffer;
  };
  /** End a job that goes on; nothing happens to others. */
  cancel_job: {
    path: [job: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["Job"]>;
  };
  /** Begin a job again that failed, was cancelled or interrupted; trials go on with those that are missing. */
  restart_job: {
    path: [job: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["Job"]>;
  };
  /** End and forget a job, with its log, its result and its files. */
  remove_job: {
    path: [job: string];
    query: Record<string, never>;
    body: undefined;
    answer: undefined;
  };
  /** Make a code that stands for the client's token, once, for 60 s. */
  make_login_code: {
    path: [];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["LoginCode"]>;
  };
  /** Show who makes the request, and its role. */
  show_session: {
    path: [];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["SessionInfo"]>;
  };
  /** Begin a session: the cookie of the answer stands for the token or code for 12 h. */
  log_in: {
    path: [];
    query: Record<string, never>;
    body: undefined;
    answer: undefined;
  };
  /** End the session of the cookie. */
  log_out: {
    path: [];
    query: Record<string, never>;
    body: undefined;
    answer: undefined;
  };
  /** List the texts of a library, and those that it may import. */
  list_library_sources: {
    path: [library: string];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["SourceInfo"]>[];
  };
  /** Read a text of a library. */
  read_library_source: {
    path: [library: string];
    query: { path: string };
    body: undefined;
    answer: Required<Schemas["SourceText"]>;
  };
  /** Change a text of a library, unless somebody else has meanwhile. */
  change_library_source: {
    path: [library: string];
    query: { path: string };
    body: Schemas["SourceChange"];
    answer: Required<Schemas["SourceText"]>;
  };
  /** List the tokens. */
  list_tokens: {
    path: [];
    query: Record<string, never>;
    body: undefined;
    answer: Required<Schemas["TokenInfo"]>[];
  };
  /** Make a token. */
  add_token: {
    path: [];
    query: Record<string, never>;
    body: Schemas["NewToken"];
    answer: Required<Schemas["MadeToken"]>;
  };
  /** Revoke a token. */
  revoke_token: {
    path: [name: string];
    query: Record<string, never>;
    body: undefined;
    answer: undefined;
  };
  /** Read the audit log: what was changed, by whom, and what was refused. */
  list_audit_entries: {
    path: [];
    query: { after?: number; limit?: number };
    body: undefined;
    answer: Required<Schemas["AuditEntry"]>[];
  };
  /** Read the metrics of the server for Prometheus. */
  show_metrics: {
    path: [];
    query: Record<string, never>;
    body: undefined;
    answer: ArrayBuffer;
  };
}

interface Place {
  method: "GET" | "POST" | "PUT" | "DELETE";
  path: string;
  isFile?: true;
}

export const REQUESTS: Record<keyof Requests, Place> = {
  list_cells: { method: "GET", path: "/cells" },
  show_cell: { method: "GET", path: "/cells/{cell}" },
  set_pace: { method: "PUT", path: "/cells/{cell}/pace" },
  acknowledge_fault: { method: "POST", path: "/cells/{cell}/acknowledge" },
  stop_cell: { method: "POST", path: "/cells/{cell}/stop" },
  reset_cell: { method: "POST", path: "/cells/{cell}/reset" },
  list_checkpoints: { method: "GET", path: "/cells/{cell}/checkpoints" },
  save_cell: { method: "POST", path: "/cells/{cell}/checkpoints" },
  restore_cell: { method: "POST", path: "/cells/{cell}/checkpoints/{checkpoint}/restore" },
  remove_checkpoint: { method: "DELETE", path: "/cells/{cell}/checkpoints/{checkpoint}" },
  disturb_cell: { method: "POST", path: "/cells/{cell}/disturbances" },
  show_model: { method: "GET", path: "/cells/{cell}/model" },
  list_poses: { method: "GET", path: "/cells/{cell}/poses" },
  show_coverage: { method: "GET", path: "/cells/{cell}/coverage" },
  show_lease: { method: "GET", path: "/cells/{cell}/lease" },
  take_lease: { method: "PUT", path: "/cells/{cell}/lease" },
  release_lease: { method: "DELETE", path: "/cells/{cell}/lease" },
  list_operations: { method: "GET", path: "/cells/{cell}/operations" },
  submit_operation: { method: "POST", path: "/cells/{cell}/operations" },
  show_operation: { method: "GET", path: "/operations/{operation}" },
  give_command: { method: "POST", path: "/operations/{operation}/commands" },
  stop_operation: { method: "POST", path: "/operations/{operation}/stop" },
  list_events: { method: "GET", path: "/operations/{operation}/events" },
  add_order: { method: "POST", path: "/cells/{cell}/orders" },
  list_orders: { method: "GET", path: "/cells/{cell}/orders" },
  remove_order: { method: "DELETE", path: "/orders/{order}" },
  list_queue: { method: "GET", path: "/cells/{cell}/queue" },
  reorder_queue: { method: "PUT", path: "/cells/{cell}/queue" },
  read_recording: { method: "GET", path: "/operations/{operation}/recording", isFile: true },
  show_tree: { method: "GET", path: "/operations/{operation}/tree" },
  explain_run: { method: "GET", path: "/operations/{operation}/why" },
  read_signals: { method: "GET", path: "/operations/{operation}/signals" },
  compare_runs: { method: "GET", path: "/operations/{operation}/diff" },
  list_facts: { method: "GET", path: "/cells/{cell}/world" },
  write_world: { method: "GET", path: "/cells/{cell}/world/document" },
  list_terms: { method: "GET", path: "/cells/{cell}/world/terms" },
  list_things: { method: "GET", path: "/cells/{cell}/things" },
  query_world: { method: "POST", path: "/cells/{cell}/world/query" },
  edit_world: { method: "POST", path: "/cells/{cell}/world/edits" },
  place_thing: { method: "POST", path: "/cells/{cell}/world/placements" },
  list_writes: { method: "GET", path: "/cells/{cell}/world/history" },
  show_version: { method: "GET", path: "/version" },
  list_libraries: { method: "GET", path: "/libraries" },
  show_library: { method: "GET", path: "/cells/{cell}/library" },
  list_robots: { method: "GET", path: "/cells/{cell}/robots" },
  add_job: { method: "POST", path: "/jobs" },
  list_jobs: { method: "GET", path: "/jobs" },
  show_job: { method: "GET", path: "/jobs/{job}" },
  show_job_result: { method: "GET", path: "/jobs/{job}/result" },
  list_job_events: { method: "GET", path: "/jobs/{job}/events" },
  read_job_file: { method: "GET", path: "/jobs/{job}/files/{file}", isFile: true },
  cancel_job: { method: "POST", path: "/jobs/{job}/cancel" },
  restart_job: { method: "POST", path: "/jobs/{job}/restart" },
  remove_job: { method: "DELETE", path: "/jobs/{job}" },
  make_login_code: { method: "POST", path: "/login-codes" },
  show_session: { method: "GET", path: "/session" },
  log_in: { method: "POST", path: "/session" },
  log_out: { method: "DELETE", path: "/session" },
  list_library_sources: { method: "GET", path: "/libraries/{library}/files" },
  read_library_source: { method: "GET", path: "/libraries/{library}/file" },
  change_library_source: { method: "PUT", path: "/libraries/{library}/file" },
  list_tokens: { method: "GET", path: "/tokens" },
  add_token: { method: "POST", path: "/tokens" },
  revoke_token: { method: "DELETE", path: "/tokens/{name}" },
  list_audit_entries: { method: "GET", path: "/audit" },
  show_metrics: { method: "GET", path: "/metrics", isFile: true },
};
