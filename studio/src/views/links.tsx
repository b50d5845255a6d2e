// Links between the views: to a line of source, to an individual, to a moment.
import type { LabelledFact, LabelledIri, LabelledValue, Position } from "../api/types";
import { select } from "../state/actions";
import { formatFact, formatValue, individualsOf } from "../state/text";
import { detailsTab } from "./layout";

/** A place in the source, which it opens. */
export function PlaceLink({ place }: { place: Position }) {
  const open = (): void => {
    select({ kind: "place", place });
    detailsTab.value = "source";
  };
  return (
    <button class="link mono" onClick={open}>
      {place.path}:{place.line}
    </button>
  );
}

/** An individual, which it selects in all views. */
export function ThingLink({ thing }: { thing: LabelledIri }) {
  return (
    <button class="link mono" title={thing.iri} onClick={() => select({ kind: "thing", iri: thing.iri })}>
      {thing.label}
    </button>
  );
}

export function Value({ value }: { value: LabelledValue }) {
  if (typeof value === "object" && value.type === "iri") return <ThingLink thing={value} />;
  return <span class="mono">{formatValue(value)}</span>;
}

interface FactProps {
  fact: LabelledFact;
  /** What a click on the fact, beside the names in it, does. */
  onEdit?: () => void;
}

/** A fact in the syntax of the language; its individuals are links. */
export function Fact({ fact, onEdit }: FactProps) {
  let rest = formatFact(fact);
  const between = (text: string) =>
    onEdit === undefined || text.trim() === "" ? (
      text
    ) : (
      <button class="fact-edit mono" title="Edit this fact" onClick={onEdit}>
        {text}
      </button>
    );
  const parts = individualsOf(fact).flatMap((each) => {
    const at = rest.indexOf(each.label);
    if (at < 0) return [];
    const before = rest.slice(0, at);
    rest = rest.slice(at + each.label.length);
    return [between(before), <ThingLink key={each.iri} thing={each} />];
  });
  return (
    <span class="mono">
      {parts}
      {between(rest)}
    </span>
  );
}
