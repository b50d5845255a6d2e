// Forms for the facts of the world: one that is shown, a new one, or several as lines. All need a reason.
import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { api } from "../api/client";
import type { LabelledFact, StatableFacts, StatableTerm } from "../api/types";
import { read } from "../state/actions";
import { changeWorld, editing } from "../state/editing";
import { cellName, facts } from "../state/studio";
import { individualsOf } from "../state/text";
import { editOfFact, editValue } from "../state/world_changes";
import { FactField } from "./FactField";
import { GoalInput } from "./GoalInput";

/** Return what facts about a thing can say; null while that is not known. */
function useTerms(subject: string): StatableFacts | null {
  const [known, setKnown] = useState<StatableFacts | null>(null);
  useEffect(() => {
    const name = cellName.value;
    let isCurrent = true;
    setKnown(null);
    if (name === null || subject === "") return;
    void read(async () => {
      const found = await api.terms(name, subject);
      if (isCurrent) setKnown(found);
    });
    return () => {
      isCurrent = false;
    };
  }, [subject]);
  return known;
}

const thingsFor = (term: StatableTerm, known: StatableFacts): string[] => [
  ...new Set(term.objects.flatMap((each) => known.things[each] ?? [])),
];

const stating = (subject: string, term: StatableTerm, value: string): string =>
  term.kind === "relation" ? `${subject} ${term.name} ${value}` : `${subject}.${term.name} == ${value}`;

interface FrameProps {
  children: ComponentChildren;
  /** The edits that are made; none if something is missing. */
  edits: readonly string[];
  /** What the button says that makes them, if any can be made. */
  action?: string;
  why?: string;
  /** What takes the fact away, and what the button says. */
  removal?: { edits: readonly string[]; label: string };
}

/** What all forms have: the reason, and the buttons. */
function Frame({ children, edits, action, why: begun = "", removal }: FrameProps) {
  const [why, setWhy] = useState(begun);
  const form = useRef<HTMLFormElement>(null);
  useEffect(() => form.current?.querySelector<HTMLElement>("input, select")?.focus(), []);
  useEffect(() => form.current?.scrollIntoView({ block: "nearest" }));
  const hasWhy = why.trim() !== "";
  const missing = hasWhy ? "" : "Say why: this is kept in the history";
  return (
    <form
      class="edit-form stack"
      ref={form}
      onSubmit={(event) => {
        event.preventDefault();
        if (edits.length > 0 && hasWhy) void changeWorld(edits, why);
      }}
      onKeyDown={(event) => {
        if (event.key !== "Escape") return;
        event.stopPropagation();
        editing.value = { kind: "nothing" };
      }}
    >
      {children}
      <div class="row wrap">
        <input
          class="why"
          aria-label="Why"
          placeholder="Why? This is kept in the history."
          value={why}
          onInput={(event) => setWhy(event.currentTarget.value)}
        />
        {action !== undefined && (
          <button class="primary" disabled={edits.length === 0 || !hasWhy} title={missing}>
            {action}
          </button>
        )}
        {removal !== undefined && (
          <button
            type="button"
            disabled={!hasWhy}
            title={missing || removal.edits.join("; ")}
            onClick={() => void changeWorld(removal.edits, why)}
          >
            {removal.label}
          </button>
        )}
        <button type="button" onClick={() => (editing.value = { kind: "nothing" })}>
          Cancel
        </button>
      </div>
    </form>
  );
}

/** Edits a fact that is shown: its value or object, or whether it holds. */
export function FactForm({ fact }: { fact: LabelledFact }) {
  const subject = individualsOf(fact)[0]?.label ?? "";
  const before = editOfFact(fact);
  if (before !== null && (fact.type === "relation" || fact.type === "property"))
    return <ValueForm fact={fact} subject={subject} before={before} />;
  if (fact.type !== "class")
    return (
      <Frame edits={[]}>
        <p class="small muted">No edit can state this value.</p>
      </Frame>
    );
  return (
    <Frame edits={[]} removal={{ edits: [`not ${subject}`], label: "Remove" }}>
      <p class="small muted">
        The class of a thing stays. <code>{subject}</code> can be removed, with all facts about it.
      </p>
    </Frame>
  );
}

type ValuedFact = Extract<LabelledFact, { type: "relation" | "property" }>;

interface ValueFormProps {
  fact: ValuedFact;
  subject: string;
  /** The fact as an edit. */
  before: string;
}

function ValueForm({ fact, subject, before }: ValueFormProps) {
  const known = useTerms(subject);
  const first = valueOf(fact);
  const [value, setValue] = useState(first);
  const iri = fact.type === "relation" ? fact.relation.iri : fact.property.iri;
  const term = known?.terms.find((each) => each.iri === iri);
  const removal = { edits: [`not ${before}`], label: "Remove" };
  if (known === null || term === undefined)
    return (
      <Frame edits={[]} removal={removal}>
        {known === null ? <Reading /> : <p class="small muted">Only its removal can be stated.</p>}
      </Frame>
    );
  const isChanged = value.trim() !== first && value.trim() !== "";
  const after = [...(term.kind === "relation" ? removal.edits : []), stating(subject, term, value.trim())];
  return (
    <Frame key="value" edits={isChanged ? after : []} action="Change" removal={removal}>
      <Statement subject={subject} term={term}>
        <FactField term={term} things={thingsFor(term, known)} value={value} onChange={setValue} />
      </Statement>
    </Frame>
  );
}

function valueOf(fact: ValuedFact): string {
  if (fact.type === "relation") return fact.object?.label ?? "";
  return fact.value === null ? "" : (editValue(fact.value) ?? "");
}

function Reading() {
  return (
    <p class="row small muted" role="status">
      <span class="spinner" /> What can be stated is read
    </p>
  );
}

interface StatementProps {
  subject: string;
  term: StatableTerm;
  children: ComponentChildren;
}

/** A fact whose value is a field. */
function Statement({ subject, term, children }: StatementProps) {
  return (
    <>
      <div class="fact-line">
        <span class="mono">
          {subject}
          {term.kind === "relation" ? ` ${term.name}` : `.${term.name} ==`}
        </span>
        {children}
      </div>
      {term.doc !== "" && <p class="small muted">{term.doc}</p>}
    </>
  );
}

/** States a new fact about a thing: its thing, then what is stated, then the value. */
export function NewFactForm({ subject: begun }: { subject: string }) {
  const [subject, setSubject] = useState(begun);
  const [name, setName] = useState("");
  const [value, setValue] = useState("");
  const names = [
    ...new Set(facts.value.flatMap((each) => individualsOf(each.fact)).map((each) => each.label)),
  ].sort();
  const isThing = names.includes(subject);
  const known = useTerms(isThing ? subject : "");
  const term = known?.terms.find((each) => each.iri === name);
  const edits = term === undefined || value.trim() === "" ? [] : [stating(subject, term, value.trim())];
  return (
    <Frame edits={edits} action="Add">
      <GoalInput
        label="Thing"
        placeholder="A thing, such as lab:Table-1"
        value={subject}
        onChange={(chosen) => {
          setSubject(chosen);
          setValue("");
        }}
        words={names}
      />
      {isThing && (
        // It stands here before it can be used, so that what is below does not move under a click.
        <label>
          <span class="visually-hidden">What is stated</span>
          <select
            class="mono fact-term"
            value={name}
            disabled={known === null}
            onChange={(event) => {
              setName(event.currentTarget.value);
              setValue("");
            }}
          >
            <option value="">{known === null ? "what can be stated is read" : "what is stated of it"}</option>
            {(known?.terms ?? []).map((each) => (
              <option key={each.iri} value={each.iri}>
                {`${each.name}: ${each.type}`}
              </option>
            ))}
          </select>
        </label>
      )}
      {term !== undefined && known !== null && (
        <Statement subject={subject} term={term}>
          <FactField
            key={term.iri}
            term={term}
            things={thingsFor(term, known)}
            value={value}
            onChange={setValue}
          />
        </Statement>
      )}
      <button
        type="button"
        class="link small"
        onClick={() => (editing.value = { kind: "lines", edits: edits.length > 0 ? edits : [""], why: "" })}
      >
        Several facts, or a new thing
      </button>
    </Frame>
  );
}

/** Changes several facts together; each is a line in the syntax in which it is shown. */
export function LinesForm({ edits, why }: { edits: readonly string[]; why: string }) {
  const [lines, setLines] = useState([...edits]);
  const change = (at: number, text: string): void =>
    setLines(lines.map((each, index) => (index === at ? text : each)));
  return (
    <Frame edits={lines.map((each) => each.trim()).filter((each) => each !== "")} action="Change" why={why}>
      <p class="small muted">
        A fact a line, as it is shown; with <code>not</code> before it if it does not hold any more.{" "}
        <code>lab:Part-9 is Product</code> adds a thing, <code>not lab:Part-9</code> removes it. All are made
        together, or none.
      </p>
      {lines.map((each, index) => (
        <GoalInput
          key={index}
          label={`Fact ${index + 1}`}
          placeholder="lab:Tray-1 contain lab:Part-1"
          value={each}
          onChange={(text) => change(index, text)}
        />
      ))}
      <button type="button" class="link small" onClick={() => setLines([...lines, ""])}>
        Another line
      </button>
    </Frame>
  );
}
