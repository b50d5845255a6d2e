// The files of a library: which one is open, what was changed in it, and breakpoints for the next operation.
import { computed, signal } from "@preact/signals";
import { api, ApiError } from "../api/client";
import type { Position } from "../api/types";
import { activeCalls } from "./operation";
import { attempt } from "./actions";
import { may, message, operation } from "./studio";

/** An open file: its text on disk with its hash, and a draft that differs from it. */
export interface OpenFile {
  library: string;
  path: string;
  text: string | null;
  etag: string;
  draft: string | null;
  problem: string;
}

export const files = signal<readonly string[]>([]);
export const source = signal<OpenFile | null>(null);
/** FILE:LINE of each place where the next operation pauses. */
export const breakpoints = signal<ReadonlySet<string>>(new Set());
export const isWritable = computed(
  () => may("edit") && source.value !== null && !source.value.path.startsWith("std/"),
);

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
  const wanted =
    path === null
      ? files.value.find((each) => each.endsWith(".skill"))
      : files.value.find((each) => each === path);
  if (wanted === undefined || source.peek()?.path === wanted) return;
  await openFile(library, wanted);
}

export async function openFile(library: string, path: string): Promise<void> {
  const before = source.peek();
  if (before?.draft != null && before.path !== path) {
    message.value = { kind: "error", text: `${before.path} has changes. Save them, or undo them, first.` };
    return;
  }
  await attempt(async () => {
    const { text, etag } = await api.readFile(library, path);
    source.value = { library, path, text, etag, draft: null, problem: "" };
  });
}

/** Write the draft, unless the file on disk is not the one that was read. */
export async function saveFile(): Promise<void> {
  const current = source.peek();
  if (current?.draft == null) return;
  const { library, path, draft, etag } = current;
  try {
    const written = await api.writeFile(library, path, draft, etag);
    source.value = { ...current, text: draft, etag: written, draft: null, problem: "" };
    message.value = {
      kind: "done",
      text: `${path} is saved. It is checked, and the next operation runs it if it has no errors.`,
    };
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    const conflict = error.status === 412;
    source.value = {
      ...current,
      problem: conflict
        ? "The file on disk has changed meanwhile. Nothing was overwritten; your text is still here."
        : error.message,
    };
  }
}

export function toggleBreakpoint(path: string, line: number): void {
  const wanted = `${path}:${line}`;
  const next = new Set(breakpoints.value);
  if (!next.delete(wanted)) next.add(wanted);
  breakpoints.value = next;
}
