// A rehearsal: the same in a simulated twin of the cell; what came of it is shown before anything real moves.
import { useEffect, useState } from "preact/hooks";
import { api, ApiError, type PlanWish } from "../api/client";
import type { Rehearsal } from "../api/types";
import { attempt } from "../state/actions";
import { replayRehearsal } from "../state/replay";
import { cellName, may } from "../state/studio";
import { describeFailure, formatTime } from "../state/text";
import { RunBadge } from "./status";

const LOOK_MS = 500;

export function Rehearse({ request }: { request: PlanWish }) {
  const [rehearsal, setRehearsal] = useState<Rehearsal | null>(null);
  const goesOn = rehearsal?.state === "going on";
  useEffect(() => {
    if (!goesOn) return;
    const timer = window.setInterval(() => {
      api.rehearsal(rehearsal.id).then(setRehearsal, (error: unknown) => {
        if (!(error instanceof ApiError)) throw error;
        setRehearsal({ ...rehearsal, state: "ended", reason: error.message });
      });
    }, LOOK_MS);
    return () => window.clearInterval(timer);
  }, [goesOn, rehearsal?.id]);
  const begin = (): void => {
    const name = cellName.value;
    if (name !== null) void attempt(async () => setRehearsal(await api.rehearse(name, request)));
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
        onClick={begin}
      >
        {goesOn ? <span class="spinner" /> : null}
        Rehearse
      </button>
      {rehearsal !== null && !goesOn && <Result rehearsal={rehearsal} name={request.task ?? "the goal"} />}
    </>
  );
}

function Result({ rehearsal, name }: { rehearsal: Rehearsal; name: string }) {
  const result = rehearsal.result;
  if (result === null) return <p class="notice bad rehearsed">The rehearsal ended: {rehearsal.reason}</p>;
  if (result.status === "refused")
    return <p class="notice bad rehearsed">{result.failure ?? "It was refused."}</p>;
  return (
    <div class="notice rehearsed stack" role="status">
      <p class="row">
        Rehearsal: <RunBadge state={result.status} verified={result.verified} claims={result.false_claims} />
        {result.sim_time_s !== undefined && <span class="mono small">{formatTime(result.sim_time_s)}</span>}
        {rehearsal.recording && (
          <button
            title="See it in all panels, before anything moves in the cell"
            onClick={() => void attempt(() => replayRehearsal(rehearsal.id, name))}
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
