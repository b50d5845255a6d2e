// Renames what is at the cursor, in all files of the library; all are saved, or none is changed.
import { useEffect, useRef, useState } from "preact/hooks";
import { ApiError } from "../api/client";
import type { SourceEditor } from "../editor/opening";
import { changeFiles } from "../state/renaming";
import { message } from "../state/studio";

interface RenameFormProps {
  editor: SourceEditor;
  library: string;
  onDone: () => void;
}

export function RenameForm({ editor, library, onDone }: RenameFormProps) {
  const [before, setBefore] = useState<string | null>(null);
  const [name, setName] = useState("");
  const [problem, setProblem] = useState("");
  const field = useRef<HTMLInputElement>(null);
  useEffect(() => field.current?.select(), [before]);
  useEffect(() => {
    void editor.nameAtCursor().then((found) => {
      if ("refused" in found) return setProblem(found.refused);
      setBefore(found.name);
      setName(found.name);
    });
  }, [editor]);
  const close = (): void => {
    onDone();
    editor.view.focus();
  };
  const submit = async (event: Event): Promise<void> => {
    event.preventDefault();
    const found = await editor.rename(name.trim());
    if ("refused" in found) return setProblem(found.refused);
    try {
      const paths = [...found.edits.keys()];
      await changeFiles(library, paths, (path, text) => editor.applyEdits(text, found.edits.get(path) ?? []));
      const places = [...found.edits.values()].reduce((sum, each) => sum + each.length, 0);
      message.value = {
        kind: "done",
        text: `${before ?? ""} is ${name} now, in ${places} places of ${paths.join(", ")}. The library is checked.`,
      };
      onDone();
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      setProblem(error.message);
    }
  };
  return (
    <form
      class="edit-form stack"
      onSubmit={(event) => void submit(event)}
      onKeyDown={(event) => {
        if (event.key !== "Escape") return;
        event.stopPropagation();
        close();
      }}
    >
      <div class="row">
        <input
          class="mono grow"
          aria-label="New name"
          placeholder={problem === "" ? "The language server is asked …" : "There is no name to change"}
          value={name}
          disabled={before === null}
          ref={field}
          onInput={(event) => setName(event.currentTarget.value)}
        />
        <button class="primary" disabled={before === null || name.trim() === "" || name === before}>
          Rename in all files
        </button>
        <button type="button" onClick={close}>
          Cancel
        </button>
      </div>
      {problem !== "" && (
        <p class="notice bad small" role="alert">
          {problem}
        </p>
      )}
    </form>
  );
}
