// A field for goals and values, with completion from the world and the vocabulary in use.
import { useMemo, useRef, useState } from "preact/hooks";
import { facts } from "../state/studio";
import { individualsOf, localName } from "../state/text";

interface GoalInputProps {
  value: string;
  onChange: (value: string) => void;
  label?: string;
  placeholder?: string;
}

const MOST = 8;

export function GoalInput({
  value,
  onChange,
  label = "Goal",
  placeholder = "lab:Table-1.isClean == true",
}: GoalInputProps) {
  const field = useRef<HTMLInputElement>(null);
  const [at, setAt] = useState(0);
  const [open, setOpen] = useState(false);
  const words = useWords();
  const word = /(?<![\w:.-])[\w:.-]*$/.exec(value)?.[0] ?? "";
  const offers =
    word.length === 0
      ? []
      : words
          .filter((each) => each.toLowerCase().includes(word.toLowerCase()) && each !== word)
          .sort((one, other) => rank(one, word) - rank(other, word))
          .slice(0, MOST);
  const isOpen = open && offers.length > 0;
  const take = (chosen: string): void => {
    onChange(value.slice(0, value.length - word.length) + chosen);
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
          setAt(0);
          setOpen(true);
        }}
        onBlur={() => setOpen(false)}
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
