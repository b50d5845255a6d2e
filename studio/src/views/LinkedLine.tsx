// A line of text in which places of source, individuals and numbers of calls are links.
import { computed } from "@preact/signals";
import { linkLine } from "../state/linking";
import { facts } from "../state/studio";
import { individualsOf } from "../state/text";
import { PlaceLink, ThingLink } from "./links";

const things = computed(
  () =>
    new Map(
      facts.value.flatMap((each) => individualsOf(each.fact)).map((each) => [each.label, each] as const),
    ),
);

interface LinkedLineProps {
  line: string;
  calls: ReadonlySet<string>;
  onCall: (number: string) => void;
}

export function LinkedLine({ line, calls, onCall }: LinkedLineProps) {
  // Lines have columns for terminals; here each is a line of its own.
  const text = line.replace(/(?<=\S) {3,}/g, "  ");
  const parts = linkLine(text, new Set(things.value.keys()), calls);
  return (
    <div class="explained-line">
      {parts.map((each, index) => {
        const thing = each.kind === "thing" ? things.value.get(each.text) : undefined;
        if (thing !== undefined) return <ThingLink key={index} thing={thing} />;
        if (each.kind === "place") return <PlaceLink key={index} place={each.place} />;
        if (each.kind !== "call") return each.text;
        return (
          <button key={index} class="link mono" onClick={() => onCall(each.text)}>
            {each.text}
          </button>
        );
      })}
    </div>
  );
}
