// The world model: facts with their evidence, searched; its history; and edits, which say why.
import { signal } from "@preact/signals";
import type { WorldFact } from "../api/types";
import { editing } from "../state/editing";
import { areFactsRead, cell, facts, mayCommand, refusalOf, things } from "../state/studio";
import { formatFact, individualsOf } from "../state/text";
import { FactForm, LinesForm, NewFactForm } from "./FactForm";
import { maximised } from "./layout";
import { Fact } from "./links";
import { WorldGraph } from "./WorldGraph";
import { WorldDifferences, WorldHistory } from "./WorldHistory";
import { WorldSkills } from "./WorldSkills";

const search = signal("");
type View = "facts" | "graph" | "skills" | "history" | "differences";
const view = signal<View>("facts");
/** What the field searches in where that is not the facts. */
const SEARCHED: Partial<Record<View, string>> = { history: "changes", skills: "skills" };

/** Show the edits that undo a change in the form, to be made with who and why. */
function proposeUndo(edits: readonly string[], why: string): void {
  editing.value = { kind: "lines", edits, why };
}

export function WorldView() {
  const current = editing.value;
  const searched = SEARCHED[view.value] ?? "facts";
  const isAdding = current.kind === "new" || current.kind === "lines";
  return (
    <div class="world">
      <div class="view-tools row">
        <input
          type="search"
          placeholder={
            searched === "facts" ? `Search in ${facts.value.length} facts` : `Search in the ${searched}`
          }
          aria-label={`Search in the ${searched}`}
          value={search.value}
          onInput={(event) => (search.value = event.currentTarget.value)}
        />
        <label>
          <span class="visually-hidden">What to show</span>
          <select value={view.value} onChange={(event) => (view.value = event.currentTarget.value as View)}>
            <option value="facts">facts</option>
            <option value="graph">graph</option>
            <option value="skills">what robots can do</option>
            <option value="history">who changed what</option>
            <option value="differences">between two times</option>
          </select>
        </label>
        <button
          disabled={!mayCommand("edit")}
          title={refusalOf("edit") || "State a fact, and say why"}
          aria-expanded={isAdding}
          onClick={() =>
            (editing.value = isAdding ? { kind: "nothing" } : { kind: "new", subject: labelOfSelected() })
          }
        >
          Add
        </button>
      </div>
      {current.kind === "new" && <NewFactForm subject={current.subject} />}
      {current.kind === "lines" && (
        <LinesForm key={current.edits.join("\n")} edits={current.edits} why={current.why} />
      )}
      <Shown />
    </div>
  );
}

/** What is chosen; facts and graph are beside each other where there is room. */
function Shown() {
  switch (view.value) {
    case "skills":
      return (
        <div class="scroll">
          <WorldSkills search={search.value} />
        </div>
      );
    case "history":
      return (
        <div class="scroll">
          <WorldHistory search={search.value} onUndo={proposeUndo} />
        </div>
      );
    case "differences":
      return (
        <div class="scroll">
          <WorldDifferences />
        </div>
      );
    case "graph":
      return <div class="scroll">{facts.value.length === 0 ? <FactTable /> : <WorldGraph />}</div>;
    case "facts":
      return (
        <div class={`world-facts ${maximised.value === "details" ? "has-graph" : ""}`}>
          <div class="scroll">
            <FactTable />
          </div>
          {maximised.value === "details" && facts.value.length > 0 && <WorldGraph />}
        </div>
      );
  }
}

function NoFacts() {
  if (cell.value?.state === "off") return <div class="empty">No facts: the cell is off.</div>;
  if (areFactsRead.value) return <div class="empty">The world of the cell is empty.</div>;
  return (
    <div class="empty" role="status">
      <span class="spinner" />
      The facts are loaded
    </div>
  );
}

function FactTable() {
  const selected = new Set(things.value);
  const text = search.value.toLowerCase();
  const isAbout = (each: WorldFact): boolean => individualsOf(each.fact).some((one) => selected.has(one.iri));
  const found = facts.value.filter(
    (each) => text === "" || formatFact(each.fact).toLowerCase().includes(text),
  );
  const shown = [...found.filter(isAbout), ...found.filter((each) => !isAbout(each))].slice(0, 500);
  if (facts.value.length === 0) return <NoFacts />;
  if (shown.length === 0) return <div class="empty">No fact has “{search.value}” in it.</div>;
  return (
    <table>
      <thead>
        <tr>
          <th>fact</th>
          <th>known</th>
        </tr>
      </thead>
      <tbody>
        {shown.map((each) => (
          <FactRow key={formatFact(each.fact)} known={each} isSelected={isAbout(each)} />
        ))}
      </tbody>
    </table>
  );
}

function FactRow({ known, isSelected }: { known: WorldFact; isSelected: boolean }) {
  const current = editing.value;
  const isEdited = current.kind === "fact" && formatFact(current.fact) === formatFact(known.fact);
  const edit = (): void => {
    editing.value = isEdited ? { kind: "nothing" } : { kind: "fact", fact: known.fact };
  };
  return (
    <>
      <tr class={isSelected ? "is-selected" : ""}>
        <td>
          <Fact fact={known.fact} onEdit={mayCommand("edit") ? edit : undefined} />
        </td>
        <td class="muted">
          {known.evidence ?? "given"}
          {known.origin ? ` by ${known.origin}` : ""}
        </td>
      </tr>
      {isEdited && (
        <tr>
          <td colSpan={2} class="fact-form">
            <FactForm fact={known.fact} />
          </td>
        </tr>
      )}
    </>
  );
}

function labelOfSelected(): string {
  const iri = things.value[0];
  const label = facts.value
    .flatMap((each) => individualsOf(each.fact))
    .find((each) => each.iri === iri)?.label;
  return label ?? "";
}
