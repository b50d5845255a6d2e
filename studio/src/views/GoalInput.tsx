// A field for goals and values, with completion from the world and the vocabulary in use.
import { useMemo, useRef, useState } from "preact/hooks";
import { facts } from "../state/studio";
import { individualsOf, localName } from "../state/text";

interface GoalInputProps {
  value: string;
  onChange: (value: string) => void;
  label?: string;
  placeholder?: string;
  /** What completes it, instead of the names that the facts have. */
  words?: readonly string[];
}

const [MOST, ALL] = [8, 200];

export function GoalInput({
  value,
  onChange,
  label = "Goal",
  placeholder = "lab:Table-1.isClean == true",
  words: given,
}: GoalInputProps) {
  const field = useRef<HTMLInputElement>(null);
  const [at, setAt] = useState(0);
  const [open, setOpen] = useState(false);
  const [isTyped, setTyped] = useState(false);
  const known = useWords();
  const words = given ?? known;
  // All that may stand here is offered until somebody types.
  const showsAll = given !== undefined && !isTyped;
  const word = showsAll ? "" : (/(?<![\w:.-])[\w:.-]*$/.exec(value)?.[0] ?? "");
  const offers =
    word.length === 0 && !showsAll
      ? []
      : words
          .filter((each) => each.toLowerCase().includes(word.toLowerCase()) && (showsAll || each !== word))
          .sort((one, other) => (showsAll ? 0 : rank(one, word) - rank(other, word)))
          .slice(0, showsAll ? ALL : MOST);
  const isOpen = open && offers.length > 0;
  const take = (chosen: string): void => {
    onChange(given === undefined ? value.slice(0, value.length - word.length) + chosen : chosen);
    setOpen(false);
    field.current?.focus();
  };
  const press = (event: KeyboardEvent): void => {
    if (!isOpen) return;
    if (event.key === "ArrowDown") setAt((at + 1) % offers.length);
    else if (event.key === "ArrowUp") setAt((at + offers.length - 1) % offers.length);
    else if (event.key === "Tab" || event.key === "Enter") take(offers[at] ?? word);
    else if (event.key === "Escape") setOpen(false);
    else return;
    event.preventDefault();
    event.stopPropagation();
  };
  const list = `offers-${label}`;
  return (
    <div class="completing">
      <input
        ref={field}
        class="mono"
        role="combobox"
        aria-label={label}
        aria-expanded={isOpen}
        aria-controls={isOpen ? list : undefined}
        aria-autocomplete="list"
        aria-activedescendant={isOpen ? `${list}-${at}` : undefined}
        autocomplete="off"
        spellcheck={false}
        placeholder={placeholder}
        value={value}
        onInput={(event) => {
          onChange(event.currentTarget.value);
          setTyped(true);
          setAt(0);
          setOpen(true);
        }}
        onClick={(event) => {
          if (given === undefined || isTyped) return;
          event.currentTarget.select();
          setAt(Math.max(0, given.indexOf(value)));
          setOpen(true);
        }}
        onBlur={() => {
          setOpen(false);
          setTyped(false);
        }}
        onKeyDown={press}
      />
      <ul id={list} role="listbox" aria-label="Completions" class="completions" hidden={!isOpen}>
        {offers.map((each, index) => (
          <li
            key={each}
            id={`${list}-${index}`}
            role="option"
            class="mono"
            aria-selected={index === at}
            ref={index === at && isOpen ? keepInSight : undefined}
            onPointerDown={(event) => {
              event.preventDefault();
              take(each);
            }}
          >
            {each}
          </li>
        ))}
      </ul>
    </div>
  );
}

const keepInSight = (offer: HTMLElement | null): void => offer?.scrollIntoView({ block: "nearest" });

/** Return how late a completion comes: those that begin with the word first, then the short ones. */
function rank(offer: string, word: string): number {
  return (offer.toLowerCase().startsWith(word.toLowerCase()) ? 0 : 1000) + offer.length;
}

/** Return the individuals, properties and relations that the facts have, and `individual.property` of each. */
function useWords(): string[] {
  const known = facts.value;
  return useMemo(() => {
    const words = new Set<string>();
    for (const { fact } of known) {
      individualsOf(fact).forEach((each) => words.add(each.label));
      if (fact.type === "relation") words.add(localName(fact.relation.iri));
      if (fact.type === "property") words.add(`${fact.individual.label}.${localName(fact.property.iri)}`);
    }
    return [...words].sort();
  }, [known]);
}
