// Feeds the signals from the server: cells and operations, the events of one operation, samples, and the world.
import { decode } from "@msgpack/msgpack";
import { batch, computed, effect } from "@preact/signals";
import { api, ApiError } from "../api/client";
import { openStream } from "../api/stream";
import type { Envelope, News, OperationStatus, Sample, WorldFact } from "../api/types";
import { takeJob } from "./jobs";
import { applyEvents, EMPTY } from "./operation";
import * as studio from "./studio";

const SAMPLES_HZ = 20;
const PAGE = 1000;
const HISTORY = 50;

/** Begin to follow the server; the function that is returned ends that. */
export function followServer(): () => void {
  const ends = [followNews(), effect(followCell), effect(followOperation)];
  return () => ends.forEach((end) => end());
}

function followNews(): () => void {
  return openStream({
    path: "/events",
    hello: () => ({}),
    onMessage: (data) => batch(() => (JSON.parse(data as string) as News[]).forEach(takeNews)),
    onStatus: (status) => {
      studio.connection.value = status;
      if (status.state === "closed") studio.session.value = null;
    },
  });
}

function takeNews(news: News): void {
  if (news.type === "status") {
    studio.cells.value = new Map(studio.cells.value).set(news.status.name, news.status);
    studio.cellName.value ??= news.status.name;
  } else if (news.type === "job") {
    takeJob(news.job, news.removed);
  } else {
    takeOperation(news.operation);
  }
}

/** Note how an operation is, unless that is known better: an answer may come after newer news. */
export function takeOperation(operation: OperationStatus): void {
  if (!isNews(studio.operations.value.get(operation.id), operation)) return;
  studio.operations.value = new Map(studio.operations.value).set(operation.id, operation);
  if (operation.cell === studio.cellName.value && !studio.ENDS.includes(operation.state))
    studio.operationId.value ??= operation.id;
}

/** Follow the samples, the library and the history of the cell that is chosen. */
function followCell(): (() => void) | undefined {
  const name = studio.cellName.value;
  if (name === null) return undefined;
  studio.sample.value = null;
  // A server or a cell that has come back knows more about what was interrupted.
  const resets = computed(() => studio.cells.value.get(name)?.resets ?? 0);
  const isThere = computed(() => studio.connection.value.state === "open" && isOn(name));
  const ends = [
    effect(() => {
      // What was interrupted before a reset can be continued no more.
      if (resets.value >= 0 && isThere.value) void loadHistory(name);
    }),
    openStream({
      path: "/samples",
      hello: () => ({ cell: name, rate_hz: SAMPLES_HZ }),
      onMessage: takeChanged((data) => (studio.sample.value = decode(data) as Sample)),
    }),
    effect(() => followLibrary(name)),
    effect(() => followWorld(name)),
  ];
  return () => ends.forEach((end) => end());
}

/** Return a function that hands on what differs from what came before: nothing is drawn of a cell that stands still. */
function takeChanged(take: (data: Uint8Array) => void): (data: string | ArrayBuffer) => void {
  let last = new Uint8Array();
  return (data) => {
    const now = new Uint8Array(data as ArrayBuffer);
    if (now.length === last.length && now.every((each, index) => each === last[index])) return;
    last = now;
    take(now);
  };
}

/** Whether what is said of an operation is not older than what is known of it. */
export function isNews(known: OperationStatus | undefined, said: OperationStatus): boolean {
  if (known === undefined) return true;
  const [hasEnded, ends] = [known, said].map((each) => studio.ENDS.includes(each.state));
  return hasEnded === ends ? said.events >= known.events : ends === true;
}

function isOn(cell: string): boolean {
  return !["off", undefined].includes(studio.cells.value.get(cell)?.state);
}

async function loadHistory(cell: string): Promise<void> {
  const found = await persistently(() => api.operations(cell, { limit: HISTORY }), isShown(cell));
  if (found === null) return;
  batch(() => {
    const known = new Map(studio.operations.value);
    for (const each of found) if (isNews(known.get(each.id), each)) known.set(each.id, each);
    studio.operations.value = known;
    if (studio.cellName.value === cell) studio.operationId.value ??= found[0]?.id ?? null;
  });
}

const isShown = (cell: string) => () => studio.cellName.peek() === cell && studio.session.peek() !== null;

function followLibrary(name: string): void {
  const cell = studio.cells.value.get(name);
  if (cell === undefined || cell.state === "off" || cell.library_hash === studio.library.peek()?.hash) return;
  void persistently(() => api.library(name), isShown(name)).then((found) => {
    if (found !== null && isShown(name)()) studio.library.value = found;
  });
}

/** Read the world again when the operation that is shown has changed it, another one has ended, or it was reset. */
function followWorld(name: string): void {
  const cell = studio.cells.value.get(name);
  const changes = studio.live.value.log.filter((each) => each.severity === "world").length;
  const ends = [...studio.operations.value.values()].filter((each) =>
    studio.ENDS.includes(each.state),
  ).length;
  if (cell === undefined || cell.state === "off") return;
  const version = `${changes} ${ends} ${cell.resets}`;
  if (worldWanted.cell === name && worldWanted.version === version) return;
  worldWanted = { cell: name, version };
  void readWorld();
}

let worldWanted = { cell: "", version: "" };
let worldRead = worldWanted;
let isReading = false;

/** Read all facts of the cell that is shown; once more if something has changed meanwhile. */
export async function readWorld(isChanged = false): Promise<void> {
  if (isChanged) worldWanted = { ...worldWanted };
  if (isReading) return;
  isReading = true;
  try {
    while (worldWanted !== worldRead) {
      const wanted = worldWanted;
      const found = await persistently(() => readFacts(wanted.cell), isShown(wanted.cell));
      if (found !== null) showFacts(found);
      worldRead = wanted;
    }
  } finally {
    isReading = false;
  }
}

interface Facts {
  facts: WorldFact[];
  sequence: number;
}

function showFacts({ facts, sequence }: Facts): void {
  batch(() => {
    studio.facts.value = facts;
    studio.areFactsRead.value = true;
    studio.worldSequence.value = sequence;
  });
}

/** Read all facts of a cell, page by page. */
async function readFacts(name: string): Promise<Facts> {
  const facts: WorldFact[] = [];
  let sequence = 0;
  for (let total = Infinity; facts.length < total;) {
    const page = await api.world(name, { offset: facts.length, limit: PAGE });
    facts.push(...page.facts);
    [total, sequence] = [page.facts.length === 0 ? 0 : page.total, page.sequence];
  }
  return { facts, sequence };
}

/** Follow the events of the operation that is chosen, from the first one. */
function followOperation(): (() => void) | undefined {
  const id = studio.operationId.value;
  studio.live.value = EMPTY;
  studio.planned.value = null;
  if (id === null) return undefined;
  const flush = inFrames((envelopes: Envelope[]) => {
    if (studio.operationId.peek() === id) studio.live.value = applyEvents(studio.live.peek(), envelopes);
  });
  const ends = [
    openStream({
      path: "/events",
      hello: () => ({ operation: id, after: studio.live.peek().lastEvent }),
      onMessage: (data) => flush(JSON.parse(data as string) as Envelope[]),
    }),
    effect(followTree(id)),
  ];
  return () => ends.forEach((end) => end());
}

const TREE_MS = 300;

/** Read the tree again after each plan and each choice of an implementation: it has what will come. */
function followTree(id: string): () => (() => void) | undefined {
  const isCurrent = (): boolean => studio.operationId.peek() === id;
  let known = "";
  return () => {
    const { attempts, nodes, ended } = studio.live.value;
    const choices = [...nodes.values()].filter((each) => each.choice !== null).length;
    const wanted = `${attempts.length} ${choices} ${ended === null}`;
    if (attempts.length === 0 || wanted === known) return undefined;
    const timer = window.setTimeout(() => {
      known = wanted;
      void persistently(() => api.tree(id), isCurrent).then((tree) => {
        if (isCurrent()) studio.planned.value = tree;
      });
    }, TREE_MS);
    return () => window.clearTimeout(timer);
  };
}

/** Return a function that collects items and hands them on once a frame, also while the page is hidden. */
function inFrames<T>(take: (items: T[]) => void): (items: T[]) => void {
  let waiting: T[] = [];
  const run = (): void => {
    const items = waiting;
    waiting = [];
    take(items);
  };
  return (items) => {
    if (waiting.length === 0) {
      if (document.hidden) window.setTimeout(run, 100);
      else requestAnimationFrame(run);
    }
    waiting.push(...items);
  };
}

const AGAIN_MS = 1500;

/** Return the answer to a request that nobody has made by hand: asked again until there is one, or it is not needed. */
async function persistently<T>(ask: () => Promise<T>, isNeeded: () => boolean): Promise<T | null> {
  while (isNeeded()) {
    try {
      return await ask();
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      if (error.status === 401) return null;
      await new Promise((resolve) => window.setTimeout(resolve, AGAIN_MS));
    }
  }
  return null;
}
