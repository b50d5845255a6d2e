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

/** Return the change of one text into another: what is between the parts that they begin and end with; null if none. */
export function changeTo(before: string, after: string): { from: number; to: number; insert: string } | null {
  if (before === after) return null;
  const shorter = Math.min(before.length, after.length);
  let from = 0;
  while (from < shorter && before[from] === after[from]) from++;
  let same = 0;
  while (same < shorter - from && before.at(-1 - same) === after.at(-1 - same)) same++;
  return { from, to: before.length - same, insert: after.slice(from, after.length - same) };
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
