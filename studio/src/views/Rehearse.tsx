// A rehearsal: the same in a simulated twin of the cell; what came of it is shown before anything real moves.
import { useState } from "preact/hooks";
import { api, type PlanWish } from "../api/client";
import type { Job } from "../api/types";
import { attempt } from "../state/actions";
import { RECORDING, runJob } from "../state/jobs";
import { replayJob } from "../state/replay";
import { cellName, may } from "../state/studio";
import { describeFailure, formatTime } from "../state/text";
import { RunBadge } from "./status";

type Outcome = Awaited<ReturnType<typeof api.jobResult>>["outcome"];
interface Rehearsal {
  job: Job;
  outcome: Outcome;
}

export function Rehearse({ request }: { request: PlanWish }) {
  const [rehearsal, setRehearsal] = useState<Rehearsal | null>(null);
  const [goesOn, setGoesOn] = useState(false);
  const begin = async (): Promise<void> => {
    const cell = cellName.value;
    if (cell === null) return;
    setGoesOn(true);
    await attempt(async () => {
      const job = await runJob({ kind: "rehearsal", cell, ...request, record: true });
      setRehearsal({ job, outcome: (await api.jobResult(job.id)).outcome });
    });
    setGoesOn(false);
  };
  return (
    <>
      <button
        disabled={!may("operate") || goesOn}
        title={
          may("operate")
            ? "Do it in a simulated twin of the cell first; nothing changes in the cell"
            : "This needs the role operate"
        }
        onClick={() => void begin()}
      >
        {goesOn ? <span class="spinner" /> : null}
        Rehearse
      </button>
      {rehearsal !== null && !goesOn && <Result rehearsal={rehearsal} name={request.task ?? "the goal"} />}
    </>
  );
}

function Result({ rehearsal: { job, outcome }, name }: { rehearsal: Rehearsal; name: string }) {
  if (outcome.kind !== "run") return null;
  const result = outcome.run;
  if (result.status === "refused")
    return <p class="notice bad rehearsed">{result.failure ?? "It was refused."}</p>;
  return (
    <div class="notice rehearsed stack" role="status">
      <p class="row">
        Rehearsal: <RunBadge state={result.status} verified={result.verified} claims={result.false_claims} />
        {result.sim_time_s !== undefined && <span class="mono small">{formatTime(result.sim_time_s)}</span>}
        {job.files.includes(RECORDING) && (
          <button
            title="See it in all panels, before anything moves in the cell"
            onClick={() => void attempt(() => replayJob(job, `rehearsal of ${name}`))}
          >
            Play it
          </button>
        )}
      </p>
      {result.cause != null && <p>{describeFailure(result.cause)}</p>}
      {result.cause == null && result.failure != null && <p>{result.failure}</p>}
    </div>
  );
}
