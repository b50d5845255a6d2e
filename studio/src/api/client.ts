// Requests to the server. What it refuses is an error with its own words.
import { REQUESTS, type Requests } from "./requests";
import type { JobRequest, OperationRequest, ProblemDetails } from "./types";
import { Turns } from "./turns";

/** The event that a request was refused because nobody is logged in any more. */
export const LOGGED_OUT = "logged-out";

const PREFIX = "/api/v1";
const PATIENCE_MS = 90_000;
/** Browsers have six connections to a server at once: two are left for Stop, and for other pages. */
const turns = new Turns(4);

/** A request that was refused, or did not arrive (`status` 0). */
export class ApiError extends Error {
  constructor(
    readonly status: number,
    message: string,
    /** The errors of a goal, a call or an argument. */
    readonly diagnostics: NonNullable<ProblemDetails["diagnostics"]> = [],
  ) {
    super(message);
  }

  /** Whether the same request may be answered soon: it did not arrive, or the server or the cell is busy or starts. */
  get isTemporary(): boolean {
    return [0, 429, 503].includes(this.status);
  }
}

type Query = Record<string, string | number | boolean | null | undefined>;

function address(path: string, query: Query = {}): string {
  const parts = Object.entries(query).filter(
    ([, value]) => value !== null && value !== undefined && value !== "",
  );
  const search = new URLSearchParams(parts.map(([name, value]) => [name, String(value)])).toString();
  return `${PREFIX}${path}${search && `?${search}`}`;
}

/** An answer, all of which has come. */
interface Answer {
  status: number;
  content: ArrayBuffer;
}

async function send(path: string, init: RequestInit): Promise<Answer> {
  let hasBegun = false;
  try {
    const response = await fetch(path, { credentials: "same-origin", ...init });
    hasBegun = true;
    return { status: response.status, content: await response.arrayBuffer() };
  } catch (error) {
    if (error instanceof DOMException && error.name === "TimeoutError")
      throw new ApiError(0, "the server did not answer in time");
    throw new ApiError(0, hasBegun ? "the answer of the server was cut off" : "the server cannot be reached");
  }
}

type Headers = Record<string, string>;

interface Manner {
  headers?: Headers;
  /** Whether it waits for no other request. */
  isUrgent?: boolean;
}

async function request(
  method: string,
  path: string,
  body?: unknown,
  { headers = {}, isUrgent = false }: Manner = {},
): Promise<Answer> {
  const json: Headers = body === undefined ? {} : { "Content-Type": "application/json" };
  const content = body === undefined ? null : JSON.stringify(body);
  const begin = (): Promise<Answer> =>
    send(path, {
      method,
      headers: { ...json, ...headers },
      body: content,
      signal: AbortSignal.timeout(PATIENCE_MS),
      priority: isUrgent ? "high" : "auto",
    });
  const answer = await (isUrgent ? begin() : turns.take(begin));
  // A secret that is refused says nothing about the session.
  if (answer.status === 401 && headers["Authorization"] === undefined)
    window.dispatchEvent(new Event(LOGGED_OUT));
  if (answer.status >= 400) throw refusal(answer);
  return answer;
}

function refusal(answer: Answer): ApiError {
  try {
    const { detail, diagnostics } = readJson(answer) as ProblemDetails;
    return new ApiError(answer.status, detail, diagnostics ?? []);
  } catch {
    return new ApiError(answer.status, `the server answered with status ${answer.status}`);
  }
}

function readJson({ content }: Answer): unknown {
  try {
    return JSON.parse(new TextDecoder().decode(content));
  } catch {
    throw new ApiError(0, "the answer of the server cannot be read");
  }
}

const part = encodeURIComponent;

type Name = keyof Requests;

/** What is given with the request of a name, besides the parts of its path. */
export interface Given<N extends Name> extends Manner {
  query?: Requests[N]["query"];
  body?: Requests[N]["body"];
}

function locate(name: Name, path: string[], query: Query = {}): string {
  const parts = [...path];
  return address(
    REQUESTS[name].path.replace(/\{\w+\}/g, () => part(parts.shift() ?? "")),
    query,
  );
}

/** Make the request of a name, with the parts of its path, and return the answer. */
export async function call<N extends Name>(
  name: N,
  path: Requests[N]["path"],
  { query, body, ...manner }: Given<N> = {},
): Promise<Requests[N]["answer"]> {
  const { method, isFile } = REQUESTS[name];
  const answer = await request(method, locate(name, path, query), body, manner);
  if (isFile) return answer.content;
  return (answer.status === 204 ? undefined : readJson(answer)) as Requests[N]["answer"];
}

export interface PlanWish {
  task?: string;
  goal?: string;
  arguments?: Record<string, string>;
  minimise?: "work" | "makespan" | "cost";
  prove?: boolean;
  deadline_s?: number;
}

/** A command such as `{type: "pause"}`. */
export type CommandBody = Requests["give_command"]["body"];

export const api = {
  session: () => call("show_session", []),
  /** Log in with a token, or with a code that is good for one time; the browser keeps the cookie. */
  logIn: (secret: string) => call("log_in", [], { headers: { Authorization: `Bearer ${secret}` } }),
  logOut: () => call("log_out", []),
  cells: () => call("list_cells", []),
  version: () => call("show_version", []),
  library: (cell: string) => call("show_library", [cell]),
  world: (cell: string, query: Requests["list_facts"]["query"] = {}) => call("list_facts", [cell], { query }),
  writes: (cell: string, query: Requests["list_writes"]["query"] = {}) =>
    call("list_writes", [cell], { query }),
  terms: (cell: string, subject: string) => call("list_terms", [cell], { query: { subject } }),
  query: (cell: string, sparql: string) => call("query_world", [cell], { body: { sparql } }),
  edit: (cell: string, edits: string[], why: string) => call("edit_world", [cell], { body: { edits, why } }),
  beginJob: (body: JobRequest) => call("add_job", [], { body }),
  jobResult: (id: string) => call("show_job_result", [id]),
  jobEvents: (id: string) => call("list_job_events", [id]),
  jobFile: (id: string, file: string) => call("read_job_file", [id, file]),
  /** The address of a page that a job has left. */
  jobPage: (id: string, file: string) => locate("read_job_file", [id, file]),
  cancelJob: (id: string) => call("cancel_job", [id]),
  restartJob: (id: string) => call("restart_job", [id]),
  removeJob: (id: string) => call("remove_job", [id]),
  devices: (cell: string) => call("list_robots", [cell]),
  lease: (cell: string) => call("show_lease", [cell]),
  /** Take the lease of a cell, or prolong it; `takeover` ends that of another client. */
  takeLease: (cell: string, durationS: number, takeover = false) =>
    call("take_lease", [cell], { body: { duration_s: durationS, takeover } }),
  releaseLease: (cell: string) => call("release_lease", [cell]),
  submit: (cell: string, body: OperationRequest, key: string) =>
    call("submit_operation", [cell], { body, headers: { "Idempotency-Key": key } }),
  operations: (cell: string, query: Requests["list_operations"]["query"] = {}) =>
    call("list_operations", [cell], { query }),
  operation: (id: string) => call("show_operation", [id]),
  events: (id: string, after: number) => call("list_events", [id], { query: { after, limit: 1000 } }),
  command: (id: string, body: CommandBody) => call("give_command", [id], { body }),
  /** Let operations come before all others that wait in a cell. */
  reorder: (cell: string, first: string[]) => call("reorder_queue", [cell], { body: { first } }),
  /** Make a simulated cell again as its scene says, or as it was saved. */
  reset: (cell: string, why: string) => call("reset_cell", [cell], { body: { why } }),
  checkpoints: (cell: string) => call("list_checkpoints", [cell]),
  save: (cell: string, name: string) => call("save_cell", [cell], { body: { name } }),
  restore: (cell: string, name: string) => call("restore_cell", [cell, name], { body: { why: "" } }),
  removeCheckpoint: (cell: string, name: string) => call("remove_checkpoint", [cell, name]),
  /** Stop all that goes on in a cell. */
  stop: (cell: string, reason: string) => call("stop_cell", [cell], { body: { reason }, isUrgent: true }),
  setPace: (cell: string, factor: number | null) => call("set_pace", [cell], { body: { factor } }),
  acknowledge: (cell: string) => call("acknowledge_fault", [cell]),
  tree: (id: string) => call("show_tree", [id]),
  why: (id: string, question: string) => call("explain_run", [id], { query: { question } }),
  signals: (id: string, match: string, afterS: number | null, everyS: number) =>
    call("read_signals", [id], {
      query: { match, every_s: everyS, ...(afterS === null ? {} : { after_s: afterS }) },
    }),
  diff: (id: string, other: string) => call("compare_runs", [id], { query: { other } }),
  libraries: () => call("list_libraries", []),
  files: (library: string) => call("list_library_sources", [library]),
  file: (library: string, path: string) => call("read_library_source", [library], { query: { path } }),
  /** Write a file if it is still the one with the hash `base`; 412 otherwise. */
  writeFile: (library: string, path: string, text: string, base: string) =>
    call("change_library_source", [library], { query: { path }, body: { text, base_hash: base } }),
  recording: (id: string) => call("read_recording", [id]),
};
