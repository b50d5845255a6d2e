// Source: the files of the library of the cell, with the line of the selected step and of what runs.
import { batch, signal } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import { cell, connection, place } from "../state/studio";
import {
  activePlaces,
  breakpoints,
  files,
  isWritable,
  openFile,
  openPath,
  readFiles,
  refreshFile,
  revertFile,
  saveFile,
  showConflict,
  source,
} from "../state/source";
import type { SourceEditor } from "../editor/opening";
import { choosing, maximised, runTab, wantedTask } from "./layout";
import { RenameForm } from "./RenameForm";

/** The editor that is shown, and whether there is anything that all safe fixes would change. */
const shownEditor = signal<SourceEditor | null>(null);
const isFixable = signal(false);
const renaming = signal(false);

/** How often the open file is looked at, which others may change on disk. */
const LOOK_MS = 2000;

export function SourceView() {
  const { library: name, library_hash: hash, library_problem: problem } = cell.value ?? {};
  useEffect(() => {
    const look = (): void => {
      if (!document.hidden && connection.peek().state === "open") void refreshFile();
    };
    const timer = window.setInterval(look, LOOK_MS);
    return () => window.clearInterval(timer);
  }, []);
  useEffect(() => {
    if (name !== undefined) void readFiles(name);
  }, [name]);
  useEffect(() => {
    const refresh = (): void => void refreshFile().then(() => shownEditor.peek()?.filesChanged());
    refresh();
    window.addEventListener("focus", refresh);
    return () => window.removeEventListener("focus", refresh);
  }, [name, hash, problem]);
  const wanted = place.value;
  useEffect(() => {
    if (name !== undefined && wanted !== null) void openPath(name, wanted.path);
    else if (name !== undefined && source.peek() === null) void openPath(name, null);
  }, [name, wanted?.path, files.value.length]);
  return (
    <div class="source">
      <SourceTools library={name ?? ""} />
      {renaming.value && shownEditor.value !== null && (
        <RenameForm editor={shownEditor.value} library={name ?? ""} onDone={() => (renaming.value = false)} />
      )}
      {source.value?.problem ? (
        <p class="notice bad row">
          <span class="grow">{source.value.problem}</span>
          {source.value.draft !== null && <button onClick={() => void showConflict()}>Compare</button>}
        </p>
      ) : null}
      {source.value === null || source.value.text === null ? (
        <div class="empty">
          {files.value.length === 0 ? "The files of this library cannot be read." : "Choose a file."}
        </div>
      ) : (
        <EditorBox key={`${source.value.library} ${source.value.path}`} />
      )}
    </div>
  );
}

function SourceTools({ library }: { library: string }) {
  const current = source.value;
  const isChanged = current !== null && current.draft !== null;
  return (
    <div class="view-tools row">
      <label class="grow">
        <span class="visually-hidden">File</span>
        <select
          class="grow"
          data-focus
          value={current?.path ?? ""}
          onChange={(event) => void openFile(library, event.currentTarget.value)}
        >
          {current === null && <option value="">choose a file</option>}
          {files.value.map((each) => (
            <option key={each.path} value={each.path}>
              {each.path}
              {each.editable ? "" : " (read only)"}
            </option>
          ))}
        </select>
      </label>
      <AssistanceTools />
      <button disabled={!isChanged} title="Go back to the file on disk" onClick={() => void revertFile()}>
        Revert
      </button>
      <button
        class="primary"
        disabled={!isChanged || !isWritable.value}
        title={isWritable.value ? "Save and check (Ctrl-S)" : UNWRITABLE}
        onClick={() => void saveFile()}
      >
        Save
      </button>
    </div>
  );
}

const UNWRITABLE = "This needs the role edit, and a file of this library";

/** What the language server changes in a text. */
function AssistanceTools() {
  const editor = shownEditor.value;
  const can = editor !== null && isWritable.value && source.value?.path.endsWith(".skill") === true;
  return (
    <>
      <button
        class="plain"
        disabled={!can}
        title={isWritable.value ? "Format (Shift-Alt-F)" : UNWRITABLE}
        onClick={() => editor?.format()}
      >
        Format
      </button>
      <button
        class="plain"
        disabled={!can}
        title={isWritable.value ? "Rename what is at the cursor, in all files (F2)" : UNWRITABLE}
        onClick={() => (renaming.value = true)}
      >
        Rename
      </button>
      {isFixable.value && (
        <button
          class="plain"
          disabled={!isWritable.value}
          title={isWritable.value ? "Apply all safe fixes; Ctrl-. fixes what is at the cursor" : UNWRITABLE}
          onClick={() => editor?.fixAll()}
        >
          Fix all
        </button>
      )}
    </>
  );
}

/** Show a task where it is planned and started. */
function chooseTask(name: string): void {
  batch(() => {
    wantedTask.value = name;
    choosing.value = true;
    runTab.value = "run";
    maximised.value = null;
  });
}

function EditorBox() {
  const box = useRef<HTMLDivElement>(null);
  const [editor, setEditor] = useState<SourceEditor | null>(null);
  useEffect(() => {
    let end = (): void => undefined;
    let isOver = false;
    void import("../editor/opening").then(({ openEditor }) => {
      const current = source.peek();
      if (isOver || box.current === null || current === null) return;
      const made = openEditor(box.current, current, {
        onRename: () => (renaming.value = isWritable.peek()),
        onTask: chooseTask,
        onFixable: (found) => (isFixable.value = found),
      });
      end = () => made.destroy();
      setEditor(made);
      shownEditor.value = made;
    });
    return () => {
      isOver = true;
      shownEditor.value = null;
      renaming.value = isFixable.value = false;
      end();
    };
  }, []);
  const path = source.value?.path ?? "";
  useEffect(() => {
    const now = source.peek(); // What was typed after this was drawn is in it.
    if (now !== null) editor?.show(now.draft ?? now.text ?? "");
  }, [editor, source.value?.draft, source.value?.text]);
  const wanted = place.value?.path === path ? place.value.line : null;
  const lines = activePlaces.value.filter((each) => each.path === path).map((each) => each.line);
  const marked = [...breakpoints.value]
    .filter((each) => each.startsWith(`${path}:`))
    .map((each) => Number(each.split(":").at(-1)));
  useEffect(() => editor?.reveal(wanted), [editor, wanted]);
  useEffect(() => editor?.mark(lines, marked), [editor, lines.join(), marked.join()]);
  return <div class="source-editor" ref={box} />;
}
