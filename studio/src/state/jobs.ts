// Jobs: work that takes its time, of whatever kind. The server says how each is; here they are begun and waited for.
import { effect, signal } from "@preact/signals";
import { api, ApiError, type PlanWish } from "../api/client";
import type { Job, JobRequest, PlanPreview } from "../api/types";

/** All jobs that the server knows, by id. */
export const jobs = signal<ReadonlyMap<string, Job>>(new Map());

/** The plans of what is being written; they are shown where it is written, and are gone soon. */
export const previews = signal<ReadonlySet<string>>(new Set());

/** What the kinds are called. */
export const KINDS: Record<JobRequest["kind"], string> = {
  plan: "Plan",
  rehearsal: "Rehearsal",
  trials: "Trials",
  "trial-replay": "Trial again",
  report: "Report",
  learn: "Learning",
};
/** The files that jobs leave. */
export const [RECORDING, REPORT, LEARNED] = ["recording.mcap", "report.html", "learned.html"] as const;

/** A job of a kind. */
export type JobOf<K extends JobRequest["kind"]> = Job & { request: Extract<JobRequest, { kind: K }> };

/** Return the jobs of a kind, the last one first. */
export function jobsOf<K extends JobRequest["kind"]>(kind: K): JobOf<K>[] {
  return [...jobs.value.values()].filter((each): each is JobOf<K> => each.request.kind === kind).reverse();
}

export const goesOn = (job: Job): boolean => job.state === "waiting" || job.state === "running";

/** Whether a job can be begun again. */
export const canRestart = (job: Job): boolean => !goesOn(job) && job.state !== "ended";

/** Note how a job is. */
export function takeJob(job: Job, removed = false): void {
  const known = new Map(jobs.peek());
  if (removed) {
    known.delete(job.id);
    previews.value = new Set([...previews.peek()].filter((each) => each !== job.id));
  } else {
    known.set(job.id, job);
  }
  jobs.value = known;
}

/** Begin a job; what the server has said of it meanwhile is newer than the answer. */
export async function beginJob(request: JobRequest): Promise<Job> {
  const begun = await api.beginJob(request);
  if (!jobs.peek().has(begun.id)) takeJob(begun);
  return begun;
}

/** Begin a job and wait until it has ended; ApiError if it fails, or somebody ends it. */
export const runJob = async (request: JobRequest): Promise<Job> => ended((await beginJob(request)).id);

function ended(id: string): Promise<Job> {
  return new Promise((resolve, reject) => {
    const end = effect(() => {
      const job = jobs.value.get(id);
      if (job !== undefined && goesOn(job)) return;
      queueMicrotask(() => end());
      if (job?.state === "ended") return resolve(job);
      const why = job === undefined ? "The job was removed." : job.reason || `The job was ${job.state}.`;
      reject(new ApiError(job?.problem?.status ?? 0, why, job?.problem?.diagnostics ?? []));
    });
  });
}

/** Plan for something, until `signal` says that nobody needs it; nothing is kept of it in the server. */
export async function previewPlan(cell: string, wish: PlanWish, signal: AbortSignal): Promise<PlanPreview> {
  const { id } = await beginJob({ kind: "plan", cell, ...wish });
  previews.value = new Set(previews.peek()).add(id);
  const remove = (): void => void api.removeJob(id).catch(ignoreRefusal);
  signal.addEventListener("abort", remove);
  let outcome;
  try {
    if (signal.aborted) throw new ApiError(0, "The plan is not needed any more.");
    await ended(id);
    ({ outcome } = await api.jobResult(id));
  } finally {
    signal.removeEventListener("abort", remove);
    if (jobs.peek().has(id)) remove();
  }
  if (outcome.kind !== "plan") throw new ApiError(0, "The server has answered something else than a plan.");
  return outcome.plan as PlanPreview;
}

function ignoreRefusal(error: unknown): void {
  if (!(error instanceof ApiError)) throw error;
}
