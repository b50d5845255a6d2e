// What is proved of a plan, what it assumes, and what its planner left out of the search, with the reasons.
import type { ArrivedPlan, PlanMade } from "../api/types";
import { describePlan, formatTime } from "../state/text";
import { Icon } from "./icons";

export function LeftOutParts({ plan, arrived }: { plan: PlanMade; arrived: ArrivedPlan | null }) {
  const least = arrived?.at_least_s ?? null;
  return (
    <section class="stack small gantt-about" aria-label="About the plan">
      <p>
        About {formatTime(plan.cost)}
        {describePlan(plan) && `, ${describePlan(plan)}`}
        {least !== null && `; every plan takes at least ${formatTime(least)}`}.{" "}
        <span class="muted">{plan.planner}</span>
      </p>
      {(arrived?.left_out ?? []).map((each, index) => (
        <p key={index} class={each.harmless ? "muted" : ""}>
          {!each.harmless && <Icon name="warning" />} Left out of the search: some {each.kind}, because{" "}
          {each.why}.{" "}
          {each.harmless ? "That is proved to make no difference." : "That may make a difference."}
        </p>
      ))}
      {(arrived?.assumptions ?? []).map((each) => (
        <p key={each} class="muted">
          Assumed: {each}
        </p>
      ))}
    </section>
  );
}
