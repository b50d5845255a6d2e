// Jobs: work that takes its time, of whatever kind. The server says how each is; here they are begun and waited for.
import { effect, signal } from "@preact/signals";
import { api, ApiError, type PlanWish } from "../api/client";
import type { Job, JobRequest, PlanPreview } from "../api/types";

/** All jobs that the server knows, by id. */
export const jobs = signal<ReadonlyMap<string, Job>>(new Map());

/** What the kinds are called. */
export const KINDS: Record<JobRequest["kind"], string> = {
  plan: "Plan",
  rehearsal: "Rehearsal",
  trials: "Trials",
  "trial-replay": "Trial again",
  report: "Report",
};
/** The files that jobs leave. */
export const [RECORDING, REPORT] = ["recording.mcap", "report.html"] as const;

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
  if (removed) known.delete(job.id);
  else known.set(job.id, job);
  jobs.value = known;
}

/** Begin a job; what the server has said of it meanwhile is newer than the answer. */
export async function beginJob(request: JobRequest, signal?: AbortSignal): Promise<Job> {
  const begun = await api.beginJob(request, signal);
  if (!jobs.peek().has(begun.id)) takeJob(begun);
  return begun;
}

/** Begin a job and wait until it has ended; ApiError if it fails, or somebody ends it. `signal` cancels it. */
export async function runJob(request: JobRequest, signal?: AbortSignal): Promise<Job> {
  const { id } = await beginJob(request, signal);
  const cancel = (): void => void api.removeJob(id).catch(ignoreRefusal);
  if (signal?.aborted === true) cancel();
  signal?.addEventListener("abort", cancel);
  try {
    return await ended(id);
  } finally {
    signal?.removeEventListener("abort", cancel);
  }
}

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

/** Plan for something; nothing is kept of it in the server. */
export async function previewPlan(cell: string, wish: PlanWish, signal: AbortSignal): Promise<PlanPreview> {
  const { id } = await runJob({ kind: "plan", cell, ...wish }, signal);
  const { outcome } = await api.jobResult(id);
  void api.removeJob(id).catch(ignoreRefusal);
  if (outcome.kind !== "plan") throw new ApiError(0, "The server has answered something else than a plan.");
  return outcome.plan as PlanPreview;
}

function ignoreRefusal(error: unknown): void {
  if (!(error instanceof ApiError)) throw error;
}
