// Quick fixes: each problem of a text with the edits that the language server offers for it.
import type { Diagnostic } from "@codemirror/lint";
import type { Text } from "@codemirror/state";
import type { EditorView } from "@codemirror/view";
import { toDiagnostics } from "./assistance";
import { changesOf, positionOf } from "./edits";
import type { LanguageServer, LspCodeAction, LspDiagnostic, LspEdit, TextEdits } from "./language_server";

const FIX_ALL = "source.fixAll.skillc";

/** The problems of a text with their fixes; `all` is what the safe fixes of the whole text change, if there are any. */
export interface Fixes {
  diagnostics: Diagnostic[];
  all: readonly LspEdit[];
}

/** Return problems with the fixes that the server has for them; `onElsewhere` makes those in other files. */
export async function findFixes(
  server: LanguageServer,
  path: string,
  doc: Text,
  found: readonly LspDiagnostic[],
  onElsewhere: (edits: TextEdits) => void,
): Promise<Fixes> {
  const plain = toDiagnostics(doc, found);
  if (found.length === 0) return { diagnostics: plain, all: [] };
  const range = { start: { line: 0, character: 0 }, end: positionOf(doc, doc.length) };
  const offered = await server.ask<LspCodeAction[]>("textDocument/codeAction", {
    range,
    context: { diagnostics: found },
  });
  const actions = (offered ?? []).map((each) => ({ each, edits: server.editsOf(each.edit).get(path) ?? [] }));
  const all = actions.find(({ each }) => each.kind === FIX_ALL)?.edits ?? [];
  const diagnostics = plain.map((diagnostic, index) => {
    const problem = found[index];
    const own = actions.filter(({ each }) =>
      each.diagnostics?.some((one) => problem !== undefined && same(one, problem)),
    );
    const here = own.filter(({ edits }) => edits.length > 0);
    const elsewhere = own.filter(({ edits }) => edits.length === 0);
    return {
      ...diagnostic,
      actions: [
        ...here.map(({ each, edits }) => actionOf(each.title, edits)),
        ...elsewhere.map(({ each }) => ({
          name: each.title,
          apply: () => onElsewhere(server.editsOf(each.edit)),
        })),
      ],
    };
  });
  return { diagnostics, all };
}

function same(one: LspDiagnostic, other: LspDiagnostic): boolean {
  return one.message === other.message && JSON.stringify(one.range) === JSON.stringify(other.range);
}

function actionOf(name: string, edits: readonly LspEdit[]) {
  return { name, apply: (view: EditorView) => applyFix(view, edits) };
}

/** Apply edits to the text of an editor that may be changed; they can be undone as what was typed. */
export function applyFix(view: EditorView, edits: readonly LspEdit[]): void {
  if (!view.state.readOnly)
    view.dispatch({ changes: changesOf(view.state.doc, edits), userEvent: "input.fix" });
}
