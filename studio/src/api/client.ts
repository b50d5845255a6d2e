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

/** The event that a request was refused because nobody is logged in any more. */
export const LOGGED_OUT = "logged-out";

const PREFIX = "/api/v1";
const PATIENCE_MS = 90_000;

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

async function send(path: string, init: RequestInit): Promise<Response> {
  try {
    return await fetch(path, {
      credentials: "same-origin",
      signal: AbortSignal.timeout(PATIENCE_MS),
      ...init,
    });
  } catch (error) {
    if (error instanceof DOMException && error.name === "TimeoutError")
      throw new ApiError(0, "the server did not answer in time");
    throw new ApiError(0, "the server cannot be reached");
  }
}

type Headers = Record<string, string>;

export async function request(
  method: string,
  path: string,
  body?: unknown,
  headers: Headers = {},
): Promise<Response> {
  const json: Headers = body === undefined ? {} : { "Content-Type": "application/json" };
  const content = body === undefined ? null : JSON.stringify(body);
  const response = await send(path, { method, headers: { ...json, ...headers }, body: content });
  if (response.status === 401) window.dispatchEvent(new Event(LOGGED_OUT));
  if (!response.ok) throw await refusal(response);
  return response;
}

async function refusal(response: Response): Promise<ApiError> {
  try {
    const problem = (await response.json()) as ProblemDetails;
    return new ApiError(response.status, problem.detail);
  } catch {
    return new ApiError(response.status, response.statusText);
  }
}

/** Return the body of an answer; ApiError if the connection ends before all of it has come. */
async function whole<T>(body: Promise<T>): Promise<T> {
  try {
    return await body;
  } catch {
    throw new ApiError(0, "the answer of the server was cut off");
  }
}

const readJson = async <T>(response: Response): Promise<T> => (await whole(response.json())) as T;
const readBytes = (response: Response): Promise<ArrayBuffer> => whole(response.arrayBuffer());

export async function read<T>(path: string, query: Query = {}): Promise<T> {
  return readJson(await request("GET", address(path, query)));
}

async function write<T>(method: string, path: string, body?: unknown, headers: Headers = {}): Promise<T> {
  const response = await request(method, address(path), body, headers);
  return response.status === 204 ? (undefined as T) : readJson(response);
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
    write<undefined>("POST", "/session", undefined, { Authorization: `Bearer ${secret}` }),
  logOut: () => write<undefined>("DELETE", "/session"),
  version: () => read<{ skillc: string; api: string }>("/version"),
  library: (cell: string) => read<LibraryDescription>(`/cells/${part(cell)}/library`),
  world: (cell: string, query: Query = {}) => read<WorldFacts>(`/cells/${part(cell)}/world`, query),
  writes: (cell: string, query: Query = {}) =>
    read<WorldWrite[]>(`/cells/${part(cell)}/world/history`, query),
  edit: (cell: string, edits: string[], why: string) =>
    write<undefined>("POST", `/cells/${part(cell)}/world/edits`, { edits, why }),
  plan: (cell: string, wish: PlanWish) => write<PlanPreview>("POST", `/cells/${part(cell)}/plans`, wish),
  /** Do something in a simulated twin of the cell; its recording can be played. */
  rehearse: (cell: string, wish: PlanWish) =>
    write<Rehearsal>("POST", `/cells/${part(cell)}/rehearsals`, { ...wish, record: true }),
  rehearsalRecording: async (id: string) =>
    readBytes(await request("GET", address(`/rehearsals/${part(id)}/recording`))),
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
  trialRecording: async (id: string, seed: number) =>
    (await request("GET", address(`/trials/${part(id)}/replays/${seed}/recording`))).arrayBuffer(),
  submit: (cell: string, wanted: OperationRequest, key: string) =>
    write<OperationStatus>("POST", `/cells/${part(cell)}/operations`, wanted, { "Idempotency-Key": key }),
  operations: (cell: string, query: Query = {}) =>
    read<OperationStatus[]>(`/cells/${part(cell)}/operations`, query),
  operation: (id: string) => read<OperationStatus>(`/operations/${part(id)}`),
  events: (id: string, after: number) =>
    read<Envelope[]>(`/operations/${part(id)}/events`, { after, limit: 1000 }),
  command: (id: string, command: CommandBody) =>
    write<OperationStatus>("POST", `/operations/${part(id)}/commands`, command),
  stop: (id: string, reason: string) =>
    write<OperationStatus>("POST", `/operations/${part(id)}/stop`, { reason }),
  stopCell: (cell: string, reason: string) =>
    write<CellStatus>("POST", `/cells/${part(cell)}/stop`, { reason }),
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
    const response = await request("PUT", address(`/libraries/${part(library)}/file`, { path }), {
      text,
      base_hash: base,
    });
    return readJson(response);
  },
  recording: async (id: string) =>
    readBytes(await request("GET", address(`/operations/${part(id)}/recording`))),
};
