// The world model: facts with their evidence, searched; its history; and edits, which say why.
import { signal } from "@preact/signals";
import { useState } from "preact/hooks";
import { api } from "../api/client";
import type { WorldFact } from "../api/types";
import { attempt } from "../state/actions";
import { readWorld } from "../state/live";
import {
  areFactsRead,
  cell,
  cellName,
  facts,
  mayCommand,
  refusalOf,
  selection,
  things,
} from "../state/studio";
import { formatFact, individualsOf } from "../state/text";
import { maximised } from "./layout";
import { Fact } from "./links";
import { WorldGraph } from "./WorldGraph";
import { WorldDifferences, WorldHistory } from "./WorldHistory";

const search = signal("");
const view = signal<"facts" | "graph" | "history" | "differences">("facts");
const editing = signal(false);
/** What the form for edits begins with. */
const proposed = signal({ edits: "", why: "" });

/** Show the edits that undo a change in the form, to be made with who and why. */
function proposeUndo(edits: readonly string[], why: string): void {
  proposed.value = { edits: edits.join("\n"), why };
  editing.value = true;
}

export function WorldView() {
  return (
    <div class="world">
      <div class="view-tools row">
        <input
          type="search"
          placeholder={`Search in ${facts.value.length} facts`}
          aria-label="Search in the facts"
          value={search.value}
          onInput={(event) => (search.value = event.currentTarget.value)}
        />
        <label>
          <span class="visually-hidden">What to show</span>
          <select
            value={view.value}
            onChange={(event) => (view.value = event.currentTarget.value as typeof view.value)}
          >
            <option value="facts">facts</option>
            <option value="graph">graph</option>
            <option value="history">who changed what</option>
            <option value="differences">between two times</option>
          </select>
        </label>
        <button
          disabled={!mayCommand("edit")}
          title={refusalOf("edit") || "Change facts, and say why"}
          aria-expanded={editing.value}
          onClick={() => {
            const begun = selection.value.kind === "thing" ? labelOfSelected() : "";
            proposed.value = { edits: begun, why: "" };
            editing.value = !editing.value;
          }}
        >
          Edit
        </button>
      </div>
      {editing.value && <EditForm key={proposed.value.edits} />}
      <Shown />
    </div>
  );
}

/** What is chosen; facts and graph are beside each other where there is room. */
function Shown() {
  switch (view.value) {
    case "history":
      return (
        <div class="scroll">
          <WorldHistory onUndo={proposeUndo} />
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
          <tr key={formatFact(each.fact)} class={isAbout(each) ? "is-selected" : ""}>
            <td>
              <Fact fact={each.fact} />
            </td>
            <td class="muted">
              {each.evidence ?? "given"}
              {each.origin ? ` by ${each.origin}` : ""}
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function EditForm() {
  const [text, setText] = useState(proposed.peek().edits);
  const [why, setWhy] = useState(proposed.peek().why);
  const submit = async (event: Event): Promise<void> => {
    event.preventDefault();
    const [name, edits] = [cellName.value, lines(text)];
    if (name === null) return;
    if (await attempt(() => api.edit(name, edits, why), `${edits.length} changed in the world.`)) {
      editing.value = false;
      await readWorld(true);
    }
  };
  return (
    <form class="edit-form stack" onSubmit={(event) => void submit(event)}>
      <label class="stack">
        <span class="small muted">
          One change a line: <code>lab:Tray-1 skiros:contain lab:Part-1</code>, the same with <code>not</code>{" "}
          before it, <code>lab:Board-1 wiping:isClean false</code>, or <code>not lab:Part-1</code> for a thing
          that is gone. All are made together, or none.
        </span>
        <textarea
          class="mono"
          rows={3}
          value={text}
          onInput={(event) => setText(event.currentTarget.value)}
        />
      </label>
      <div class="row">
        <input
          aria-label="Why"
          placeholder="Why? This is kept in the history."
          value={why}
          onInput={(event) => setWhy(event.currentTarget.value)}
        />
        <button class="primary" disabled={lines(text).length === 0 || why.trim() === ""}>
          Change
        </button>
        <button type="button" onClick={() => (editing.value = false)}>
          Cancel
        </button>
      </div>
    </form>
  );
}

const lines = (text: string): string[] =>
  text
    .split("\n")
    .map((each) => each.trim())
    .filter((each) => each !== "");

function labelOfSelected(): string {
  const iri = things.value[0];
  const label = facts.value
    .flatMap((each) => individualsOf(each.fact))
    .find((each) => each.iri === iri)?.label;
  return label === undefined ? "" : `${label} `;
}
