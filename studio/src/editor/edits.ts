// Edits of texts as the language server gives them: for the open editor, or for the text of another file.
import { Text, type ChangeSpec } from "@codemirror/state";
import type { LspEdit, LspPosition } from "./language_server";

export function offsetOf(doc: Text, { line, character }: LspPosition): number {
  if (line >= doc.lines) return doc.length;
  const at = doc.line(line + 1);
  return Math.min(at.to, at.from + character);
}

export function positionOf(doc: Text, offset: number): LspPosition {
  const line = doc.lineAt(offset);
  return { line: line.number - 1, character: offset - line.from };
}

/** Return edits as changes of a document. */
export function changesOf(doc: Text, edits: readonly LspEdit[]): ChangeSpec[] {
  return edits.map((each) => ({
    from: offsetOf(doc, each.range.start),
    to: offsetOf(doc, each.range.end),
    insert: each.newText,
  }));
}

/** Return a text with edits, which are about the text before all of them and do not overlap. */
export function applyEdits(text: string, edits: readonly LspEdit[]): string {
  const doc = Text.of(text.split("\n"));
  const ordered = edits
    .map((each) => ({
      from: offsetOf(doc, each.range.start),
      to: offsetOf(doc, each.range.end),
      text: each.newText,
    }))
    .sort((one, other) => other.from - one.from);
  return ordered.reduce((now, each) => now.slice(0, each.from) + each.text + now.slice(each.to), text);
}
