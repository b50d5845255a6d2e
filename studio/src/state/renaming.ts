// Changes of several files of a library: all are written, or none stays.
import { api, ApiError } from "../api/client";
import type { SourceText } from "../api/types";
import { openFile, source } from "./source";

/** A file with its text before and after a change. */
interface Change {
  path: string;
  before: SourceText;
  text: string;
}

/** Change files of a library; `change` returns the new text of one. ApiError if one cannot be written: then none is. */
export async function changeFiles(
  library: string,
  paths: readonly string[],
  change: (path: string, text: string) => string,
): Promise<void> {
  const current = source.peek();
  const changes = await Promise.all(
    paths.map(async (path): Promise<Change> => {
      const before = await api.file(library, path);
      if (!before.editable) throw new ApiError(0, `${path} is not of this library; nothing was changed.`);
      const isOpen = current?.path === path;
      if (isOpen && before.hash !== current.hash)
        throw new ApiError(412, `${path} has changed on disk; nothing was changed.`);
      return { path, before, text: change(path, isOpen ? (current.draft ?? before.text) : before.text) };
    }),
  );
  const written: { path: string; before: string; hash: string }[] = [];
  try {
    for (const { path, before, text } of changes) {
      const { hash } = await api.writeFile(library, path, text, before.hash);
      written.push({ path, before: before.text, hash });
    }
  } catch (error) {
    for (const each of written) await api.writeFile(library, each.path, each.before, each.hash);
    throw error;
  }
  if (current !== null) {
    source.value = { ...current, draft: null };
    await openFile(library, current.path);
  }
}
