// The files of a library: which one is open, what was changed in it, and breakpoints for the next operation.
import { computed, signal } from "@preact/signals";
import { api, ApiError } from "../api/client";
import type { Requests } from "../api/requests";
import type { Position } from "../api/types";
import { activeCalls } from "./operation";
import { attempt, command } from "./actions";
import { may, mayCommand, message, ongoing, operation } from "./studio";

/** An open file: its text on disk with its hash, and a draft that differs from it. */
export interface OpenFile {
  library: string;
  path: string;
  text: string | null;
  hash: string;
  editable: boolean;
  draft: string | null;
  problem: string;
}

export const files = signal<readonly Requests["list_library_sources"]["answer"][number][]>([]);
export const source = signal<OpenFile | null>(null);
/** FILE:LINE of each place where the next operation pauses. */
export const breakpoints = signal<ReadonlySet<string>>(new Set());
/** A draft whose file has another text on disk meanwhile. */
export interface Conflict {
  path: string;
  mine: string;
  theirs: string;
  /** The hash of the file as it is shown. */
  hash: string;
}
export const conflict = signal<Conflict | null>(null);
export const isWritable = computed(() => may("edit") && (source.value?.editable ?? false));

/** The lines of the calls that run now. */
export const activePlaces = computed<Position[]>(() =>
  activeCalls(operation.value).map((each) => each.source),
);

export async function readFiles(library: string): Promise<void> {
  try {
    files.value = await api.files(library);
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    files.value = [];
  }
}

/** Open a file that an event names; without one, the first of the library. A file with a draft stays open. */
export async function openPath(library: string, path: string | null): Promise<void> {
  const names = files.value.map((each) => each.path);
  const wanted =
    path ?? files.value.find((each) => each.editable && each.path.endsWith(".skill"))?.path ?? names[0];
  if (wanted === undefined || !names.includes(wanted) || source.peek()?.path === wanted) return;
  await openFile(library, wanted);
}

/** How many files were asked for: only the last one is shown, in whatever order they arrive. */
let asked = 0;

export async function openFile(library: string, path: string): Promise<void> {
  const before = source.peek();
  if (before?.draft != null && before.path !== path) {
    message.value = { kind: "error", text: `${before.path} has changes. Save them, or undo them, first.` };
    return;
  }
  const number = ++asked;
  await attempt(async () => {
    const { text, hash, editable } = await api.file(library, path);
    if (number !== asked) return;
    source.value = { library, path, text, hash, editable, draft: null, problem: "" };
  });
}

/** Read the open file again if somebody else has changed it; a draft stays, and is compared when it is saved. */
export async function refreshFile(): Promise<void> {
  const current = source.peek();
  if (current === null || current.draft !== null) return;
  try {
    const { text, hash, editable } = await api.file(current.library, current.path);
    if (hash !== current.hash && source.peek() === current)
      source.value = { ...current, text, hash, editable };
  } catch (error) {
    // A file that is gone, or a server that is away: what was read stays.
    if (!(error instanceof ApiError)) throw error;
  }
}

/** Write the draft, unless the file on disk is not the one that was read; then say what the check of it says. */
export async function saveFile(): Promise<void> {
  const current = source.peek();
  if (current?.draft == null) return;
  const { library, path, draft, hash } = current;
  try {
    const written = await api.writeFile(library, path, draft, hash);
    source.value = { ...current, text: draft, hash: written.hash, draft: null, problem: "" };
    message.value = { kind: "done", text: `${path} is saved, and the library is checked …` };
    await reportCheck(library);
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    source.value = { ...current, problem: error.status === 412 ? CHANGED : error.message };
    if (error.status === 412) await showConflict();
  }
}

const CHANGED = "The file on disk has changed meanwhile. Nothing was overwritten; your text is still here.";

/** Show the draft beside the file that somebody else has changed. */
export async function showConflict(): Promise<void> {
  const current = source.peek();
  if (current?.draft == null) return;
  const { library, path, draft } = current;
  await attempt(async () => {
    const { text, hash } = await api.file(library, path);
    conflict.value = { path, mine: draft, theirs: text, hash };
  });
}

/** Go back to the editor; the draft stays, and so does the file. */
export function leaveConflict(): void {
  conflict.value = null;
}

/** Write a text in the place of the file as it was shown beside it. */
export async function keepMine(text: string): Promise<void> {
  const [current, shown] = [source.peek(), conflict.peek()];
  if (current === null || shown === null) return;
  conflict.value = null;
  source.value = { ...current, hash: shown.hash, draft: text };
  await saveFile();
}

const CHECK_MS = 1000;

async function reportCheck(library: string): Promise<void> {
  let found = (await api.libraries()).find((each) => each.name === library);
  while (found?.pending === true) {
    await new Promise((resolve) => window.setTimeout(resolve, CHECK_MS));
    found = (await api.libraries()).find((each) => each.name === library);
  }
  if (found === undefined) return;
  message.value =
    found.problem === ""
      ? { kind: "done", text: "The library has no errors. The next operation runs it." }
      : { kind: "error", text: `The next operation still runs the library as it was: ${found.problem}` };
}

/** Throw the draft away, and read the file on disk again. */
export async function revertFile(): Promise<void> {
  const current = source.peek();
  if (current === null) return;
  conflict.value = null;
  source.value = { ...current, draft: null };
  await openFile(current.library, current.path);
}

/** Set or remove a breakpoint: for the next operation, and for those that go on in the cell. */
export function toggleBreakpoint(path: string, line: number): void {
  const wanted = `${path}:${line}`;
  const isSet = !breakpoints.value.has(wanted);
  const changed = (before: Iterable<string>): string[] =>
    [...new Set([...before, wanted])].filter((each) => isSet || each !== wanted).sort();
  breakpoints.value = new Set(changed(breakpoints.value));
  if (!mayCommand()) return;
  for (const each of ongoing.value)
    if (each.allowed.includes("set-breakpoints"))
      void command({ type: "set-breakpoints", breakpoints: changed(each.breakpoints) }, each.id);
}
