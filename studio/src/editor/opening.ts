// Opens the editor of a file of a library, with the language server for it; one server serves all files of a library.
import { forEachDiagnostic, type Action } from "@codemirror/lint";
import { keymap, type EditorView } from "@codemirror/view";
import type { Position } from "../api/types";
import { isWritable, saveFile, source, toggleBreakpoint, type OpenFile } from "../state/source";
import { attempt, select } from "../state/actions";
import { changeFiles } from "../state/renaming";
import { annotate, annotated, LENS_COMMANDS, type TestAnswer } from "./annotations";
import { assistance, completionsOf, format } from "./assistance";
import { applyEdits, positionOf } from "./edits";
import { makeEditor, type Editor } from "./editor";
import { applyFix, findFixes } from "./fixes";
import {
  LanguageServer,
  type LspCodeAction,
  type LspDiagnostic,
  type LspEdit,
  type TextEdits,
} from "./language_server";
import { references, showReferences } from "./references";

/** An editor with what the buttons beside it do. */
export interface SourceEditor extends Editor {
  format(): void;
  /** Look at the problems again, as another file of the library may have changed. */
  filesChanged(): void;
  /** Apply all safe fixes. */
  fixAll(): void;
  /** Return the name at the cursor, or why it cannot be renamed. */
  nameAtCursor(): Promise<{ name: string } | { refused: string }>;
  /** Return what another name for it changes, in which files; or why that is not possible. */
  rename(name: string): Promise<{ edits: TextEdits } | { refused: string }>;
  /** Return a text with edits. */
  applyEdits: typeof applyEdits;
}

export interface SourceEditorOptions {
  onRename: () => void;
  /** Called with a task of the library that is to be run or planned. */
  onTask: (name: string) => void;
  /** Called with whether there is anything that all safe fixes would change. */
  onFixable: (isFixable: boolean) => void;
}

/** How the path of a file begins that pages cannot read. */
const HIDDEN = "skill-hidden:///";

let server: { library: string; client: LanguageServer } | null = null;
let listener: (path: string, found: LspDiagnostic[]) => void = () => undefined;

function serverOf(library: string): LanguageServer {
  if (server?.library !== library) {
    server?.client.close();
    const onDiagnostics = (path: string, found: LspDiagnostic[]): void => listener(path, found);
    server = { library, client: new LanguageServer(library, LENS_COMMANDS, onDiagnostics) };
  }
  return server.client;
}

/** Show a file in an element; what is typed becomes its draft. */
export function openEditor(element: HTMLElement, file: OpenFile, options: SourceEditorOptions): SourceEditor {
  const client = serverOf(file.library);
  const text = file.draft ?? file.text ?? "";
  const keys = keymap.of([
    { key: "F2", run: () => (options.onRename(), true) },
    { key: "Mod-.", run: fixAtCursor },
  ]);
  const onGo = (place: Position): void => select({ kind: "place", place });
  const onTest = async (name: string): Promise<TestAnswer> => {
    const answer = await client.demand("skillc/runTest", { name });
    return "refused" in answer ? answer : (answer.result as TestAnswer);
  };
  const lenses = { onTask: options.onTask, onReferences: showReferences, onTest };
  const editor = makeEditor(element, {
    text,
    path: file.path,
    readOnly: !isWritable.peek(),
    onChange: (changed) => {
      client.show(file.path, changed);
      const now = source.peek();
      if (now?.path === file.path) source.value = { ...now, draft: changed === now.text ? null : changed };
    },
    onSave: () => void saveFile(),
    onBreakpoint: (line) => toggleBreakpoint(file.path, line),
    complete: completionsOf(client),
    extensions: [keys, assistance(client, onGo), references(client, onGo), annotated(client, lenses)],
  });
  const { view } = editor;
  let safe: readonly LspEdit[] = [];
  const changeOthers = (edits: TextEdits): void => {
    const change = (path: string, before: string): string => applyEdits(before, edits.get(path) ?? []);
    const paths = [...edits.keys()];
    void attempt(() => changeFiles(file.library, paths, change), `${paths.join(", ")} is changed.`);
  };
  /** Show problems, unless there are newer ones; once more if the text has changed while their fixes were asked for. */
  const diagnose = async (found: LspDiagnostic[]): Promise<void> => {
    const { doc } = view.state;
    const { diagnostics, all } = await findFixes(client, file.path, doc, found, changeOthers);
    if (client.problems(file.path) !== found) return;
    if (view.state.doc !== doc) return diagnose(found);
    safe = all;
    options.onFixable(all.length > 0);
    editor.diagnose(diagnostics);
  };
  listener = (path, found) => {
    if (path !== file.path) return;
    void diagnose(found);
    void annotate(client, view, lenses);
  };
  client.show(file.path, text);
  const known = client.problems(file.path);
  if (known !== null) {
    void diagnose(known);
    void annotate(client, view, lenses);
  }
  const position = () => positionOf(view.state.doc, view.state.selection.main.head);
  return {
    ...editor,
    applyEdits,
    format: () => {
      void format(client, view);
      view.focus();
    },
    filesChanged: () => client.changedOnDisk(file.path),
    fixAll: () => {
      applyFix(view, safe);
      view.focus();
    },
    nameAtCursor: async () => {
      const found = await client.demand("textDocument/prepareRename", {
        position: position(),
      });
      return "refused" in found ? found : { name: (found.result as { placeholder: string }).placeholder };
    },
    rename: async (newName) => {
      const found = await client.demand("textDocument/rename", {
        position: position(),
        newName,
      });
      if ("refused" in found) return found;
      const edits = client.editsOf(found.result as LspCodeAction["edit"]);
      const hidden = [...edits.keys()].find((each) => each.startsWith(HIDDEN));
      return hidden === undefined
        ? { edits }
        : { refused: `It is also named in ${hidden.slice(HIDDEN.length)}, which pages cannot change.` };
    },
  };
}

/** Apply the first fix of a problem at the cursor. */
function fixAtCursor(view: EditorView): boolean {
  const at = view.state.selection.main.head;
  let first: { action: Action; from: number; to: number } | null = null;
  forEachDiagnostic(view.state, (diagnostic, from, to) => {
    const action = diagnostic.actions?.[0];
    if (first === null && action !== undefined && from <= at && at <= to) first = { action, from, to };
  });
  const found = first as { action: Action; from: number; to: number } | null;
  found?.action.apply(view, found.from, found.to);
  return found !== null;
}
