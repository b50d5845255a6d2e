// Finds what a line of `skillc why` names: places of source, individuals, and the number of the call at its beginning.
import type { Position } from "../api/types";

export type LinePart =
  { kind: "text" | "thing" | "call"; text: string } | { kind: "place"; text: string; place: Position };

/** A place, a name with a prefix, or a number of a call at the beginning of a line. */
const NAMED =
  /(?<![\w./-])(?<path>[\w./-]+\.(?:skill|ttl)):(?<line>\d+)|(?<![\w-])[A-Za-z_][\w-]*:[\w-]+|(?<=^\s*)\d+(?:\.\d+)*(?=\s{2})/g;

/** Return a line in parts; those that are named are links if they are in `things` or `calls`. */
export function linkLine(line: string, things: ReadonlySet<string>, calls: ReadonlySet<string>): LinePart[] {
  const parts: LinePart[] = [];
  let end = 0;
  for (const match of line.matchAll(NAMED)) {
    const part = partOf(match, things, calls);
    if (part === null) continue;
    if (match.index > end) parts.push({ kind: "text", text: line.slice(end, match.index) });
    parts.push(part);
    end = match.index + match[0].length;
  }
  if (end < line.length) parts.push({ kind: "text", text: line.slice(end) });
  return parts;
}

function partOf(
  { 0: text, groups }: RegExpExecArray,
  things: ReadonlySet<string>,
  calls: ReadonlySet<string>,
): LinePart | null {
  const path = groups?.["path"];
  if (path !== undefined)
    return { kind: "place", text, place: { path, line: Number(groups?.["line"]), column: 1 } };
  if (things.has(text)) return { kind: "thing", text };
  return calls.has(text) ? { kind: "call", text } : null;
}
