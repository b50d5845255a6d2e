// The facts that a success rests on, each with how it is known, and why no better.
import type { KnownFact } from "../api/types";
import { Fact } from "./links";

export function KnownFacts({ facts }: { facts: readonly KnownFact[] }) {
  return (
    <ul>
      {facts.map((each, index) => (
        <li key={index}>
          <Fact fact={each.fact} />{" "}
          <span class="muted">
            {each.known}
            {each.by ? ` by ${each.by}` : ""}
            {each.known === "idealised" && each.with_physics ? ", verified in simulation only" : ""}
            {each.why ? `: ${each.why}` : ""}
          </span>
        </li>
      ))}
    </ul>
  );
}
