// Colours for skill files: a tokeniser that is good enough to read; the language server knows the rest.
import { StreamLanguage, type StringStream } from "@codemirror/language";
import { KEYWORDS, TYPES } from "./keywords";

const WORD = /^[A-Za-z_][\w-]*/;

function token(stream: StringStream): string | null {
  if (stream.eatSpace()) return null;
  if (stream.match(/^#+.*/)) return "comment";
  if (stream.match(/^"[^"]*"?/)) return "string";
  if (stream.match(/^<[^>\s]*>/)) return "link";
  if (stream.match(/^\d+(\.\d+)?([eE][+-]?\d+)?/)) return "number";
  const word = stream.match(WORD);
  if (word === null || word === false || word === true) {
    stream.next();
    return null;
  }
  const text = word[0];
  if (stream.match(/^:[A-Za-z_][\w-]*/)) return "variableName";
  if (KEYWORDS.has(text)) return "keyword";
  return TYPES.has(text) ? "typeName" : "variableName";
}

export const skillLanguage = StreamLanguage.define({
  name: "skill",
  token,
  languageData: { commentTokens: { line: "#" }, closeBrackets: { brackets: ["(", "[", "{", '"'] } },
});
