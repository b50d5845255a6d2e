// Jobs are begun by a request, and waited for with what the server says of all of them.
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { ApiError } from "../src/api/client";
import type { Job } from "../src/api/types";
import { canRestart, goesOn, jobs, jobsOf, previewPlan, runJob, takeJob } from "../src/state/jobs";

const job = (id: string, state: Job["state"], more: Partial<Job> = {}): Job =>
  ({ id, state, request: { kind: "rehearsal" }, reason: "", problem: null, files: [], ...more }) as Job;

let asked: string[] = [];
beforeEach(() => {
  asked = [];
  jobs.value = new Map();
  vi.stubGlobal("window", new EventTarget());
});
afterEach(() => vi.unstubAllGlobals());

/** Answer requests by method and path. */
function answer(answers: Record<string, unknown>): void {
  vi.stubGlobal("fetch", (path: string, { method }: RequestInit) => {
    const name = `${method} ${path.replace("/api/v1", "")}`;
    asked.push(name);
    const value = answers[name];
    const body = value === undefined ? null : JSON.stringify(value);
    return Promise.resolve(new Response(body, { status: value === undefined ? 204 : 200 }));
  });
}

test("a job is waited for until the server says that it has ended", async () => {
  answer({ "POST /jobs": job("a", "waiting") });
  const running = runJob({ kind: "rehearsal", cell: "yard", goal: "g" });
  await vi.waitFor(() => expect(jobs.value.get("a")?.state).toBe("waiting"));
  takeJob(job("a", "running"));
  takeJob(job("b", "ended"));
  takeJob(job("a", "ended", { files: ["recording.mcap"] }));
  expect((await running).files).toEqual(["recording.mcap"]);
});

test("what the server has said before its answer arrives is newer", async () => {
  answer({ "POST /jobs": job("a", "waiting") });
  takeJob(job("a", "ended"));
  expect((await runJob({ kind: "rehearsal", goal: "g" })).state).toBe("ended");
});

test("one that fails is an error with its diagnostics, one that is removed an error", async () => {
  answer({ "POST /jobs": job("a", "waiting") });
  const problem = { title: "", status: 422, detail: "no such crate", diagnostics: [{ name: "unknown" }] };
  takeJob(job("a", "failed", { reason: "no such crate", problem } as unknown as Partial<Job>));
  const error: unknown = await runJob({ kind: "rehearsal", goal: "g" }).catch((each: unknown) => each);
  expect(error).toBeInstanceOf(ApiError);
  expect(error).toMatchObject({ status: 422, message: "no such crate", diagnostics: [{ name: "unknown" }] });
  takeJob(job("a", "running"));
  const running = runJob({ kind: "rehearsal", goal: "g" });
  setTimeout(() => takeJob(job("a", "running"), true));
  await expect(running).rejects.toThrow("removed");
});

test("a plan that is not needed any more is ended, and nothing is kept of one that is", async () => {
  const outcome = { kind: "plan", plan: { status: "solved" } };
  answer({ "POST /jobs": job("a", "waiting"), "GET /jobs/a/result": { job: "a", outcome } });
  const ending = new AbortController();
  const given = previewPlan("yard", { goal: "g" }, ending.signal);
  await vi.waitFor(() => expect(jobs.value.has("a")).toBe(true));
  ending.abort();
  await vi.waitFor(() => expect(asked).toEqual(["POST /jobs", "DELETE /jobs/a"]));
  takeJob(job("a", "running"), true);
  await expect(given).rejects.toThrow(ApiError);
  takeJob(job("a", "ended"));
  expect(await previewPlan("yard", { goal: "g" }, new AbortController().signal)).toEqual({
    status: "solved",
  });
  expect(asked.slice(2)).toEqual(["POST /jobs", "GET /jobs/a/result", "DELETE /jobs/a"]);
});

test("jobs of a kind, what goes on, and what can be begun again", () => {
  for (const state of ["waiting", "running", "ended", "failed", "cancelled", "interrupted"] as const)
    takeJob(job(state, state));
  takeJob(job("other", "ended", { request: { kind: "report", operation: "o" } }));
  expect(jobsOf("report").map((each) => each.request.operation)).toEqual(["o"]);
  expect(jobsOf("rehearsal").filter(goesOn)).toHaveLength(2);
  expect(jobsOf("rehearsal").filter(canRestart)).toHaveLength(3);
});
