// Opens the editor of a file of a library, with the language server for it; one server serves all files of a library.
import { isWritable, saveFile, source, toggleBreakpoint, type OpenFile } from "../state/source";
import { select } from "../state/actions";
import { assistance, completionsOf, toDiagnostics } from "./assistance";
import { makeEditor, type Editor } from "./editor";
import { LanguageServer, type LspDiagnostic } from "./language_server";

let server: { library: string; client: LanguageServer } | null = null;
let listener: (path: string, found: LspDiagnostic[]) => void = () => undefined;

function serverOf(library: string): LanguageServer {
  if (server?.library !== library) {
    server?.client.close();
    server = { library, client: new LanguageServer(library, (path, found) => listener(path, found)) };
  }
  return server.client;
}

/** Show a file in an element; what is typed becomes its draft. */
export function openEditor(element: HTMLElement, file: OpenFile): Editor {
  const client = serverOf(file.library);
  const text = file.draft ?? file.text ?? "";
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
    extensions: assistance(client, (place) => select({ kind: "place", place })),
  });
  listener = (path, found) => {
    if (path === file.path) editor.diagnose(toDiagnostics(editor.view.state.doc, found));
  };
  client.show(file.path, text);
  return editor;
}
