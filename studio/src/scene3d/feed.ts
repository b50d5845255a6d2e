// Brings what the 3-D view shows: the model of a cell, believed poses and coverage from the server, the rest from the page.
import { computed, effect, signal } from "@preact/signals";
import { ApiError, call } from "../api/client";
import { attempt, select } from "../state/actions";
import type { ChosenPosture, PoseNumbers } from "../api/types";
import { readWorld } from "../state/live";
import { isReal } from "../state/real_arms";
import { shownPostures } from "../state/plan_step";
import { rehearsed } from "../state/replay";
import {
  cells,
  live,
  operationId,
  refusalOf,
  replay,
  shownSample,
  things,
  worldSequence,
} from "../state/studio";
import { findPaths } from "./paths";
import type {
  BelievedPoses,
  CellModel,
  Displacement,
  PlannedPosture,
  Sample,
  SceneActions,
  SceneSources,
  SurfaceCoverage,
} from "./types";

type Coverage = Readonly<Record<string, SurfaceCoverage>>;

const COVERAGE_MS = 400;
const RETRY_MS = 2000;
/** How far apart in time the points of a planned path are. */
const PATH_S = 0.1;

const model = signal<CellModel | null>(null);
const believed = signal<BelievedPoses>({});
const coverage = signal<Coverage>({});
/** What was rehearsed is planned until an operation that was begun after it has ended. */
const isPlanned = computed(() => {
  const { operation = null } = rehearsed.value ?? {};
  return operationId.value === operation || live.value.ended === null;
});
const rehearsedPaths = computed(() => {
  if (model.value === null || rehearsed.value === null) return [];
  return findPaths(model.value, rehearsed.value.film.every(PATH_S));
});
const paths = computed(() => (isPlanned.value ? rehearsedPaths.value : []));

const postures = computed(() => shownPostures.value.map(readPosture));

let last = "";
let lastSample: Sample | null = null;
/** The sample that is shown: the same one while nothing but time passes, as nothing has to be drawn then. */
const sample = computed(() => {
  const now = JSON.stringify({ ...shownSample.value, time_s: 0 });
  if (now !== last) [last, lastSample] = [now, shownSample.value];
  return lastSample;
});

export const sceneSources: SceneSources = {
  model,
  believed,
  sample,
  selected: things,
  coverage: computed(() => (replay.value === null ? coverage.value : {})),
  paths,
  postures,
};

/** Return a posture of a plan as the view takes it. */
function readPosture({ arm, q, tool, base }: ChosenPosture): PlannedPosture {
  return { arm: arm.iri, joints: q, tool: readPose(tool), base: base ? readPose(base) : null };
}

function readPose({ position_m, quaternion_wxyz }: ChosenPosture["tool"]): PoseNumbers {
  return [...position_m, ...quaternion_wxyz];
}

/** Follow a cell until the function that is returned is called. */
export function followScene(cell: string): () => void {
  const isOn = computed(() => !["off", undefined].includes(cells.value.get(cell)?.state));
  const resets = computed(() => cells.value.get(cell)?.resets ?? 0);
  model.value = null;
  believed.value = coverage.value = {};
  const ends = [
    effect(() =>
      resets.value >= 0 && isOn.value
        ? keepReading(() => call("show_model", [cell]) as Promise<CellModel>, model)
        : undefined,
    ),
    effect(() => {
      return isOn.value && worldSequence.value >= 0
        ? keepReading<BelievedPoses>(() => call("list_poses", [cell]), believed)
        : undefined;
    }),
    followCoverage(cell),
  ];
  return () => ends.forEach((end) => end());
}

/** Read something into a signal, again until it is there; the function that is returned gives up. */
function keepReading<T>(ask: () => Promise<T>, into: { value: T | null }): () => void {
  let isOver = false;
  let timer = 0;
  const run = (): void => {
    ask().then(
      (found) => {
        if (!isOver) into.value = found;
      },
      (error: unknown) => {
        if (!(error instanceof ApiError)) throw error;
        if (!isOver && error.status !== 401) timer = window.setTimeout(run, RETRY_MS);
      },
    );
  };
  run();
  return () => {
    isOver = true;
    window.clearTimeout(timer);
  };
}

/** Read the coverage again and again while time passes in the cell. */
function followCoverage(cell: string): () => void {
  let time = -1;
  let isReading = false;
  const timer = window.setInterval(() => {
    const now = shownSample.peek()?.time_s ?? -1;
    const isOff = cells.peek().get(cell)?.state === "off";
    if (isOff || isReading || replay.peek() !== null || now === time || document.hidden) return;
    isReading = true;
    call("show_coverage", [cell]).then(
      (found) => {
        [time, isReading, coverage.value] = [now, false, found];
      },
      () => (isReading = false),
    );
  }, COVERAGE_MS);
  return () => window.clearInterval(timer);
}

/** What a person may do in the view of a cell, by the role and the lease. */
export function sceneActions(cell: string): SceneActions {
  return {
    select: (iri) => select(iri === null ? { kind: "nothing" } : { kind: "thing", iri }),
    isReal,
    refusals: computed(() => ({
      disturb: isReal.value ? "Nothing of this cell is simulated." : refusalOf("operate"),
      correct: refusalOf("edit"),
    })),
    disturb: (displacement) => disturb(cell, displacement),
    take: (displacement) => take(cell, displacement),
    correct: (displacement, why) => correct(cell, displacement, why),
  };
}

function disturb(cell: string, { individual, label, by_m }: Displacement): Promise<boolean> {
  const body = { type: "move" as const, thing: individual, by_m: [...by_m] as [number, number, number] };
  return attempt(
    () => call("disturb_cell", [cell], { body }),
    `${label} was moved in the simulated reality; the cell does not know it`,
  );
}

function take(cell: string, { individual, label, by_m }: Displacement): Promise<boolean> {
  const aside = by_m.some((each) => each !== 0) ? { by_m: [...by_m] as [number, number, number] } : {};
  return attempt(
    () => call("disturb_cell", [cell], { body: { type: "take", thing: individual, ...aside } }),
    `${label} was taken out of the hand; the fingers close, and find out`,
  );
}

async function correct(
  cell: string,
  { individual, label, pose }: Displacement,
  why: string,
): Promise<boolean> {
  const body = { thing: individual, pose: [...pose] as PoseNumbers, why };
  const isDone = await attempt(
    () => call("place_thing", [cell], { body }),
    `The cell believes that ${label} is there; nothing has moved`,
  );
  if (isDone) await readWorld(true);
  return isDone;
}
