// What the language server does for the editor: problems, completion, hover, go to the definition, and formatting.
import {
  type Completion,
  type CompletionContext,
  type CompletionResult,
  pickedCompletion,
} from "@codemirror/autocomplete";
import type { Diagnostic } from "@codemirror/lint";
import { Prec, type Extension, type Text } from "@codemirror/state";
import { EditorView, hoverTooltip, keymap } from "@codemirror/view";
import type { Position } from "../api/types";
import { changesOf, offsetOf, positionOf } from "./edits";
import type {
  LanguageServer,
  LspCompletion,
  LspDiagnostic,
  LspEdit,
  LspLocation,
  LspPosition,
} from "./language_server";

const SEVERITIES = { 1: "error", 2: "warning", 3: "info", 4: "hint" } as const;

/** Return problems of the server as those of the editor. */
export function toDiagnostics(doc: Text, found: readonly LspDiagnostic[]): Diagnostic[] {
  return found.map((each) => ({
    from: offsetOf(doc, each.range.start),
    to: offsetOf(doc, each.range.end),
    severity: SEVERITIES[each.severity ?? 1],
    message: each.message,
  }));
}

/** Return completions at the cursor. */
export function completionsOf(server: LanguageServer) {
  return async (context: CompletionContext): Promise<CompletionResult | null> => {
    const word = context.matchBefore(/[\w:-]*/);
    const before = context.state.sliceDoc(Math.max(0, context.pos - 1), context.pos);
    if (!context.explicit && (word === null || word.from === word.to) && before !== ".") return null;
    const position = positionOf(context.state.doc, context.pos);
    const found = await server.ask<LspCompletion[] | { items: LspCompletion[] }>("textDocument/completion", {
      position,
    });
    const items = Array.isArray(found) ? found : (found?.items ?? []);
    const options = items.map((each) => ({
      label: each.label,
      apply: applied(each),
      ...(each.detail === undefined ? {} : { detail: each.detail }),
    }));
    return options.length === 0 ? null : { from: word?.from ?? context.pos, options, validFor: /^[\w:-]*$/ };
  };
}

/** Return what choosing a completion does: its text, and the lines elsewhere that it needs, such as an `import`. */
function applied(
  item: LspCompletion,
): string | ((view: EditorView, chosen: Completion, from: number, to: number) => void) {
  const text = item.textEdit?.newText ?? item.insertText ?? item.label;
  const more = item.additionalTextEdits ?? [];
  if (more.length === 0) return text;
  return (view, chosen, from, to) => {
    const changes = view.state.changes([{ from, to, insert: text }, ...changesOf(view.state.doc, more)]);
    const selection = { anchor: changes.mapPos(to, 1) };
    view.dispatch({
      changes,
      selection,
      userEvent: "input.complete",
      annotations: pickedCompletion.of(chosen),
    });
  };
}

/** Return what the editor shows and does with the help of the server; `onGo` opens a place. */
export function assistance(server: LanguageServer, onGo: (place: Position) => void): Extension {
  const goTo = (view: EditorView, offset: number): boolean => {
    void definition(server, positionOf(view.state.doc, offset)).then(
      (place) => place !== null && onGo(place),
    );
    return true;
  };
  const explain = hoverTooltip(async (view, offset) => {
    if (view.dom.querySelector(".cm-lenses:hover") !== null) return null; // It is above the line, not in it.
    const text = await hover(server, positionOf(view.state.doc, offset));
    return text === "" ? null : { pos: offset, above: true, create: () => ({ dom: hoverBox(text) }) };
  });
  return [
    Prec.lowest(explain), // Below what is wrong there.
    keymap.of([
      { key: "F12", run: (view) => goTo(view, view.state.selection.main.head) },
      { key: "Shift-Alt-f", run: (view) => format(server, view) },
    ]),
    EditorView.domEventHandlers({
      click: (event, view) => {
        if (!event.ctrlKey && !event.metaKey) return false;
        const offset = view.posAtCoords({ x: event.clientX, y: event.clientY });
        return offset !== null && goTo(view, offset);
      },
    }),
  ];
}

type Markup = string | { value: string };

async function hover(server: LanguageServer, position: LspPosition): Promise<string> {
  const found = await server.ask<{ contents: Markup | Markup[] }>("textDocument/hover", { position });
  if (found === null) return "";
  const parts = Array.isArray(found.contents) ? found.contents : [found.contents];
  return parts.map((each) => (typeof each === "string" ? each : each.value)).join("\n\n");
}

function hoverBox(text: string): HTMLElement {
  const box = document.createElement("div");
  box.className = "cm-hover-text";
  const plain = text.replaceAll(/```\w*\n?/g, "").replaceAll(/\*\*([^*]+)\*\*/g, "$1");
  box.textContent = plain.trim();
  return box;
}

async function definition(server: LanguageServer, position: LspPosition): Promise<Position | null> {
  const found = await server.ask<LspLocation | LspLocation[]>("textDocument/definition", { position });
  const first = Array.isArray(found) ? found[0] : found;
  return first == null || !first.uri.startsWith("skill:") ? null : server.placeOf(first);
}

/** Format the text, unless it has errors. */
export function format(server: LanguageServer, view: EditorView): boolean {
  const { doc } = view.state;
  if (view.state.readOnly) return false;
  void server
    .demand("textDocument/formatting", { options: { tabSize: 4, insertSpaces: true } })
    .then((found) => {
      if (!("result" in found) || view.state.doc !== doc) return;
      view.dispatch({ changes: changesOf(doc, found.result as LspEdit[]) });
    });
  return true;
}
