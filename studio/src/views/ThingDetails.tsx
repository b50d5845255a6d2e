// An individual: what is known about it, and how that is known.
import type { LabelledFact } from "../api/types";
import { statedDirtMap } from "../state/dirt_map";
import { editing } from "../state/editing";
import { facts, mayCommand, shownSample } from "../state/studio";
import { formatNumber, individualsOf } from "../state/text";
import { DirtPicture } from "./DirtPicture";
import { detailsTab } from "./layout";
import { Fact } from "./links";

function edit(fact: LabelledFact): void {
  editing.value = { kind: "fact", fact };
  detailsTab.value = "world";
}

/** The picture of a fact that states a map of dirt. */
function Dirt({ fact }: { fact: LabelledFact }) {
  const map = statedDirtMap(fact);
  return map === null ? null : <DirtPicture map={map} of={individualsOf(fact)[0]?.label ?? ""} />;
}

export function ThingDetails({ iri }: { iri: string }) {
  const about = facts.value.filter((each) => individualsOf(each.fact).some((one) => one.iri === iri));
  const label =
    about.flatMap((each) => individualsOf(each.fact)).find((each) => each.iri === iri)?.label ?? iri;
  const pose = shownSample.value?.things[iri];
  return (
    <>
      <p class="row">
        <strong class="mono">{label}</strong>
      </p>
      <p class="small muted wrap-anywhere">{iri}</p>
      {pose !== undefined && (
        <p class="small">
          Really at{" "}
          <span class="mono">
            (
            {pose
              .slice(0, 3)
              .map((each) => formatNumber(each, 4))
              .join(", ")}
            ) m
          </span>
        </p>
      )}
      {about.map((each, index) => (
        <Dirt key={index} fact={each.fact} />
      ))}
      {about.length === 0 ? (
        <p class="muted">The world model has no fact about it.</p>
      ) : (
        <ul>
          {about.map((each, index) => (
            <li key={index}>
              <Fact fact={each.fact} onEdit={mayCommand("edit") ? () => edit(each.fact) : undefined} />{" "}
              <span class="muted small">
                {each.evidence ?? "given"}
                {each.origin ? ` by ${each.origin}` : ""}
              </span>
            </li>
          ))}
        </ul>
      )}
    </>
  );
}
