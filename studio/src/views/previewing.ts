// Plans for what is chosen, before it is started; all panels see the plan.
import { useEffect, useState } from "preact/hooks";
import { ApiError, type PlanWish } from "../api/client";
import type { PlanPreview } from "../api/types";
import { fixesFor, type GoalFix } from "../state/goal_fixes";
import { previewPlan } from "../state/jobs";
import { shownStep } from "../state/plan_step";
import { cell, preview, worldSequence } from "../state/studio";

/** How long nothing has to change before there is a plan, and when a server that was busy is asked again. */
const [SETTLED_MS, AGAIN_MS] = [200, 1500];

interface Found {
  preview: PlanPreview | null;
  /** Why there can be no plan for what is wanted, and what to write instead. */
  problem: string;
  fixes: readonly GoalFix[];
}
const NOTHING: Found = { preview: null, problem: "", fixes: [] };

/** Plan again whenever what is wanted, or the world, has changed. */
export function usePreview(request: PlanWish, isPlanned: boolean): Found {
  const [found, setFound] = useState<Found>(NOTHING);
  const wanted = JSON.stringify(request);
  const name = cell.value?.name;
  useEffect(() => {
    preview.value = found.preview;
    return () => {
      preview.value = null;
      shownStep.value = null;
    };
  }, [found.preview]);
  useEffect(() => {
    if (name === undefined || !isPlanned) return;
    let isCurrent = true;
    // A plan that nobody needs any more keeps a planner of the server, and a connection of the browser.
    const ending = new AbortController();
    setFound(NOTHING);
    const ask = (): void => {
      previewPlan(name, request, ending.signal).then(
        (preview) => isCurrent && setFound({ ...NOTHING, preview }),
        (error: unknown) => {
          if (!(error instanceof ApiError)) throw error;
          if (!isCurrent) return;
          if (error.isTemporary) timer = window.setTimeout(ask, AGAIN_MS);
          else
            setFound({
              preview: null,
              problem: error.message,
              fixes: fixesFor(request.goal ?? "", error.diagnostics),
            });
        },
      );
    };
    let timer = window.setTimeout(ask, SETTLED_MS);
    return () => {
      isCurrent = false;
      ending.abort();
      window.clearTimeout(timer);
    };
  }, [wanted, name, isPlanned, worldSequence.value]);
  return found;
}
