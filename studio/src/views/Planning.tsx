// How far the planner is: the best plan so far and the proved bound, which grow towards each other.
import { bounds } from "../state/bounds";
import { status } from "../state/studio";
import { formatTime } from "../state/text";
import { BoundsChart } from "./BoundsChart";

export function Planning() {
  const progress = status.value?.planning ?? null;
  return (
    <div class="stack planning" role="status">
      <p class="row muted">
        <span class="spinner" /> Planning
        {progress !== null && <span class="small truncate">with {progress.planner}</span>}
      </p>
      {progress !== null && (
        <Bounds
          best={progress.best_s ?? null}
          least={progress.at_least_s ?? 0}
          costs={progress.costs ?? false}
        />
      )}
      <BoundsChart {...bounds.value} />
      {(progress?.states ?? 0) > 0 && (
        <p class="small muted mono">{progress?.states?.toLocaleString("en")} states evaluated</p>
      )}
      {progress?.narrowed && (
        <p class="small muted">{progress.individuals} things; the others are left out of the search</p>
      )}
    </div>
  );
}

function Bounds({ best, least, costs }: { best: number | null; least: number; costs: boolean }) {
  const any = costs ? `each costs ${least} or more` : `each takes at least ${formatTime(least)}`;
  if (best === null) return <p class="small">{least > 0 ? `No plan yet; ${any}.` : "No plan yet."}</p>;
  return (
    <>
      <p class="small">
        Best plan so far: {costs ? `cost ${best}` : formatTime(best)}
        {least > 0 && `; ${any}`}
      </p>
      <progress
        aria-label="How much of the best plan is proved to be needed"
        max={best}
        value={Math.min(least, best)}
      />
    </>
  );
}
