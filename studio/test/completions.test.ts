// A completion that needs an import brings its line, and the cursor stays behind what was chosen.
import { CompletionContext } from "@codemirror/autocomplete";
import { EditorState, type TransactionSpec } from "@codemirror/state";
import type { EditorView } from "@codemirror/view";
import { expect, test } from "vitest";
import { completionsOf } from "../src/editor/assistance";
import type { LanguageServer } from "../src/editor/language_server";

const TOP = { line: 0, character: 0 };

test("a name that is not visible brings the line that makes it so", async () => {
  const word = { start: { line: 1, character: 0 }, end: { line: 1, character: 2 } };
  const item = {
    label: "Inspect",
    textEdit: { range: word, newText: "Inspect" },
    additionalTextEdits: [{ range: { start: TOP, end: TOP }, newText: 'import "a.skill"\n' }],
  };
  const server = { ask: () => Promise.resolve({ items: [item] }) } as unknown as LanguageServer;
  let state = EditorState.create({ doc: "do\nIn" });
  const found = await completionsOf(server)(new CompletionContext(state, 5, true));
  const option = found?.options[0];
  if (option === undefined || typeof option.apply !== "function") throw new Error("nothing to apply");
  const dispatch = (change: TransactionSpec): void => void (state = state.update(change).state);
  option.apply({ state, dispatch } as unknown as EditorView, option, 3, 5);
  expect(state.doc.toString()).toBe('import "a.skill"\ndo\nInspect');
  expect(state.selection.main.head).toBe(state.doc.length);
});
