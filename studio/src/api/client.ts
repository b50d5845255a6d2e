// Requests to the server. What it refuses is an error with its own words.
import type {
  CellStatus,
  DeviceStatus,
  Envelope,
  Lease,
  LibraryDescription,
  LibraryStatus,
  OperationReport,
  OperationRequest,
  OperationStatus,
  OperationTree,
  PlanPreview,
  ProblemDetails,
  Rehearsal,
  RunDiff,
  RunExplanation,
  Session,
  SignalRows,
  Series,
  SourceText,
  TrialReplay,
  TrialSeries,
  TrialsRequest,
  WorldFacts,
  WorldWrite,
} from "./types";
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
    if (error instanceof DOMException && error.name === "AbortError")
      throw new ApiError(0, "the answer is not needed any more");
    throw new ApiError(0, hasBegun ? "the answer of the server was cut off" : "the server cannot be reached");
  }
}

/** Return what ends a request: its patience, and `signal` if there is one. */
function endingWith(signal: AbortSignal | undefined): AbortSignal {
  const patience = AbortSignal.timeout(PATIENCE_MS);
  if (signal === undefined) return patience;
  const either = new AbortController();
  if (signal.aborted) either.abort();
  for (const each of [patience, signal]) each.addEventListener("abort", () => either.abort(each.reason));
  return either.signal;
}

type Headers = Record<string, string>;

export interface Manner {
  headers?: Headers;
  /** What ends the request when its answer is not needed any more. */
  signal?: AbortSignal;
  /** Whether it waits for no other request. */
  isUrgent?: boolean;
}

export async function request(
  method: string,
  path: string,
  body?: unknown,
  { headers = {}, signal, isUrgent = false }: Manner = {},
): Promise<Answer> {
  const json: Headers = body === undefined ? {} : { "Content-Type": "application/json" };
  const content = body === undefined ? null : JSON.stringify(body);
  const begin = (): Promise<Answer> =>
    send(path, {
      method,
      headers: { ...json, ...headers },
      body: content,
      signal: endingWith(signal),
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
    return new ApiError(answer.status, (readJson(answer) as ProblemDetails).detail);
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

export async function read<T>(path: string, query: Query = {}): Promise<T> {
  return readJson(await request("GET", address(path, query))) as T;
}

async function write<T>(method: string, path: string, body?: unknown, manner: Manner = {}): Promise<T> {
  const answer = await request(method, address(path), body, manner);
  return answer.status === 204 ? (undefined as T) : (readJson(answer) as T);
}

async function readBytes(path: string): Promise<ArrayBuffer> {
  return (await request("GET", address(path))).content;
}

export const part = encodeURIComponent;

export interface PlanWish {
  task?: string;
  goal?: string;
  arguments?: Record<string, string>;
  minimise?: "work" | "makespan";
  prove?: boolean;
  deadline_s?: number;
}

/** A command such as `{type: "pause"}`. */
export type CommandBody = { type: string } & Record<string, unknown>;

/** A file of a library; `editable` if it is its own. */
export interface SourceName {
  path: string;
  editable: boolean;
}

export const api = {
  session: () => read<Session>("/session"),
  /** Log in with a token, or with a code that is good for one time; the browser keeps the cookie. */
  logIn: (secret: string) =>
    write<undefined>("POST", "/session", undefined, { headers: { Authorization: `Bearer ${secret}` } }),
  logOut: () => write<undefined>("DELETE", "/session"),
  cells: () => read<CellStatus[]>("/cells"),
  version: () => read<{ skillc: string; api: string }>("/version"),
  library: (cell: string) => read<LibraryDescription>(`/cells/${part(cell)}/library`),
  world: (cell: string, query: Query = {}) => read<WorldFacts>(`/cells/${part(cell)}/world`, query),
  writes: (cell: string, query: Query = {}) =>
    read<WorldWrite[]>(`/cells/${part(cell)}/world/history`, query),
  edit: (cell: string, edits: string[], why: string) =>
    write<undefined>("POST", `/cells/${part(cell)}/world/edits`, { edits, why }),
  plan: (cell: string, wish: PlanWish, signal: AbortSignal) =>
    write<PlanPreview>("POST", `/cells/${part(cell)}/plans`, wish, { signal }),
  /** Do something in a simulated twin of the cell; its recording can be played. */
  rehearse: (cell: string, wish: PlanWish) =>
    write<Rehearsal>("POST", `/cells/${part(cell)}/rehearsals`, { ...wish, record: true }),
  rehearsalRecording: (id: string) => readBytes(`/rehearsals/${part(id)}/recording`),
  rehearsal: (id: string) => read<Rehearsal>(`/rehearsals/${part(id)}`),
  devices: (cell: string) => read<DeviceStatus[]>(`/cells/${part(cell)}/robots`),
  lease: (cell: string) => read<Lease>(`/cells/${part(cell)}/lease`),
  /** Take the lease of a cell, or prolong it; `takeover` ends that of another client. */
  takeLease: (cell: string, durationS: number, takeover = false) =>
    write<Lease>("PUT", `/cells/${part(cell)}/lease`, { duration_s: durationS, takeover }),
  releaseLease: (cell: string) => write<undefined>("DELETE", `/cells/${part(cell)}/lease`),
  trials: (cell: string) => read<TrialSeries[]>(`/cells/${part(cell)}/trials`),
  beginTrials: (cell: string, wanted: TrialsRequest) =>
    write<TrialSeries>("POST", `/cells/${part(cell)}/trials`, wanted),
  removeTrials: (id: string) => write<undefined>("DELETE", `/trials/${part(id)}`),
  trialsResult: (id: string) => read<Series>(`/trials/${part(id)}/result`),
  /** Run a trial again in simulation, and record it. */
  replayTrial: (id: string, seed: number) =>
    write<TrialReplay>("POST", `/trials/${part(id)}/replays/${seed}`),
  trialReplay: (id: string, seed: number) => read<TrialReplay>(`/trials/${part(id)}/replays/${seed}`),
  trialRecording: (id: string, seed: number) => readBytes(`/trials/${part(id)}/replays/${seed}/recording`),
  submit: (cell: string, wanted: OperationRequest, key: string) =>
    write<OperationStatus>("POST", `/cells/${part(cell)}/operations`, wanted, {
      headers: { "Idempotency-Key": key },
    }),
  operations: (cell: string, query: Query = {}) =>
    read<OperationStatus[]>(`/cells/${part(cell)}/operations`, query),
  operation: (id: string) => read<OperationStatus>(`/operations/${part(id)}`),
  events: (id: string, after: number) =>
    read<Envelope[]>(`/operations/${part(id)}/events`, { after, limit: 1000 }),
  command: (id: string, command: CommandBody) =>
    write<OperationStatus>("POST", `/operations/${part(id)}/commands`, command),
  /** Stop all that goes on in a cell. */
  stop: (cell: string, reason: string) =>
    write<CellStatus>("POST", `/cells/${part(cell)}/stop`, { reason }, { isUrgent: true }),
  setPace: (cell: string, factor: number | null) =>
    write<CellStatus>("PUT", `/cells/${part(cell)}/pace`, { factor }),
  acknowledge: (cell: string) => write<CellStatus>("POST", `/cells/${part(cell)}/acknowledge`),
  report: (id: string) => read<OperationReport>(`/operations/${part(id)}/report`),
  makeReport: (id: string) =>
    write<OperationReport>("POST", `/operations/${part(id)}/report`, { film: false }),
  reportPage: (id: string) => address(`/operations/${part(id)}/report/report.html`),
  tree: (id: string) => read<OperationTree>(`/operations/${part(id)}/tree`),
  why: (id: string, question: string) => read<RunExplanation>(`/operations/${part(id)}/why`, { question }),
  signals: (id: string, match: string, afterS: number | null) =>
    read<SignalRows>(`/operations/${part(id)}/signals`, { match, after_s: afterS }),
  diff: (id: string, other: string) => read<RunDiff>(`/operations/${part(id)}/diff`, { other }),
  libraries: () => read<LibraryStatus[]>("/libraries"),
  files: (library: string) => read<SourceName[]>(`/libraries/${part(library)}/files`),
  file: (library: string, path: string) => read<SourceText>(`/libraries/${part(library)}/file`, { path }),
  /** Write a file if it is still the one with the hash `base`; 412 otherwise. */
  writeFile: async (library: string, path: string, text: string, base: string): Promise<SourceText> => {
    const body = { text, base_hash: base };
    const place = address(`/libraries/${part(library)}/file`, { path });
    return readJson(await request("PUT", place, body)) as SourceText;
  },
  recording: (id: string) => readBytes(`/operations/${part(id)}/recording`),
};
