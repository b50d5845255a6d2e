// The editor of a file: CodeMirror with the colours of the theme, breakpoints, and the lines that run.
import {
  autocompletion,
  closeBrackets,
  completionKeymap,
  type CompletionSource,
} from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { bracketMatching, HighlightStyle, syntaxHighlighting } from "@codemirror/language";
import { lintGutter, lintKeymap, setDiagnostics, type Diagnostic } from "@codemirror/lint";
import { highlightSelectionMatches, search, searchKeymap } from "@codemirror/search";
import { EditorState, RangeSet, StateEffect, StateField, type Extension } from "@codemirror/state";
import {
  Decoration,
  EditorView,
  gutter,
  GutterMarker,
  highlightActiveLine,
  highlightSpecialChars,
  keymap,
  lineNumbers,
  type DecorationSet,
} from "@codemirror/view";
import { tags } from "@lezer/highlight";
import { changeTo } from "./edits";
import { skillLanguage } from "./language";

export interface EditorOptions {
  text: string;
  path: string;
  readOnly: boolean;
  onChange: (text: string) => void;
  onSave: () => void;
  onBreakpoint: (line: number) => void;
  complete?: CompletionSource;
  extensions?: Extension;
}

export interface Editor {
  /** Show another text; the cursor stays where it is in what both have in common. */
  show(text: string): void;
  /** Bring a line into sight and mark it as selected; null marks none. */
  reveal(line: number | null): void;
  /** Mark the lines that run, and those with a breakpoint. */
  mark(running: readonly number[], breakpoints: readonly number[]): void;
  diagnose(diagnostics: readonly Diagnostic[]): void;
  view: EditorView;
  destroy(): void;
}

interface Marks {
  selected: number | null;
  running: readonly number[];
  breakpoints: readonly number[];
}

const setMarks = StateEffect.define<Partial<Marks>>();
const marks = StateField.define<Marks>({
  create: () => ({ selected: null, running: [], breakpoints: [] }),
  update: (value, transaction) =>
    transaction.effects.reduce(
      (now, effect) => (effect.is(setMarks) ? { ...now, ...effect.value } : now),
      value,
    ),
  provide: (field) =>
    EditorView.decorations.compute([field, "doc"], (state) => decorate(state, state.field(field))),
});

function decorate(state: EditorState, { selected, running }: Marks): DecorationSet {
  const found = [
    ...running.map((line) => [line, "cm-running"] as const),
    ...(selected === null ? [] : [[selected, "cm-chosen"] as const]),
  ].filter(([line]) => line >= 1 && line <= state.doc.lines);
  return Decoration.set(
    found.map(([line, name]) => Decoration.line({ class: name }).range(state.doc.line(line).from)),
    true,
  );
}

class BreakpointMarker extends GutterMarker {
  override toDOM(): Node {
    const dot = document.createElement("span");
    dot.className = "cm-breakpoint";
    dot.title = "Breakpoint: the next operation pauses here";
    return dot;
  }
}
const breakpoint = new BreakpointMarker();

function breakpointGutter(onBreakpoint: (line: number) => void): Extension {
  return gutter({
    class: "cm-breakpoints",
    markers: (view) => {
      const { doc } = view.state;
      const lines = view.state.field(marks).breakpoints.filter((each) => each >= 1 && each <= doc.lines);
      return RangeSet.of(
        [...lines].sort((one, other) => one - other).map((each) => breakpoint.range(doc.line(each).from)),
      );
    },
    lineMarkerChange: (update) => update.startState.field(marks) !== update.state.field(marks),
    initialSpacer: () => breakpoint,
    domEventHandlers: {
      mousedown: (view, line) => {
        onBreakpoint(view.state.doc.lineAt(line.from).number);
        return true;
      },
    },
  });
}

export function makeEditor(parent: HTMLElement, options: EditorOptions): Editor {
  const view = new EditorView({
    parent,
    state: EditorState.create({ doc: options.text, extensions: extensionsOf(options) }),
  });
  view.scrollDOM.tabIndex = 0; // So that it can be scrolled with the keyboard, as axe wants it.
  return {
    view,
    show: (text) => {
      const change = changeTo(view.state.doc.toString(), text);
      if (change !== null) view.dispatch({ changes: change });
    },
    reveal: (line) => {
      const effects: StateEffect<unknown>[] = [setMarks.of({ selected: line })];
      if (line !== null && line <= view.state.doc.lines)
        effects.push(EditorView.scrollIntoView(view.state.doc.line(line).from, { y: "center" }));
      view.dispatch({ effects });
    },
    mark: (running, breakpoints) => view.dispatch({ effects: setMarks.of({ running, breakpoints }) }),
    diagnose: (diagnostics) => view.dispatch(setDiagnostics(view.state, diagnostics)),
    destroy: () => view.destroy(),
  };
}

/** Return what all editors of a file share: its colours, its numbers of lines, what can be undone, and what is found. */
export function editorBasics(path: string): Extension[] {
  const nonce = document.querySelector<HTMLMetaElement>('meta[name="csp-nonce"]')?.content ?? "";
  return [
    EditorView.cspNonce.of(nonce),
    lineNumbers(),
    highlightSpecialChars(),
    history(),
    syntaxHighlighting(COLOURS),
    LOOK,
    ...(path.endsWith(".skill") ? [skillLanguage] : []),
    keymap.of([...defaultKeymap, ...historyKeymap]),
  ];
}

function extensionsOf(options: EditorOptions): Extension[] {
  const nonce = document.querySelector<HTMLMetaElement>('meta[name="csp-nonce"]')?.content ?? "";
  const toggleHere = (view: EditorView): boolean => {
    options.onBreakpoint(view.state.doc.lineAt(view.state.selection.main.head).number);
    return true;
  };
  const save = (): boolean => {
    options.onSave();
    return true;
  };
  return [
    EditorView.cspNonce.of(nonce),
    marks,
    breakpointGutter(options.onBreakpoint),
    lineNumbers(),
    highlightSpecialChars(),
    lintGutter(),
    history(),
    bracketMatching(),
    closeBrackets(),
    search({ top: true }),
    highlightSelectionMatches(),
    highlightActiveLine(),
    autocompletion(options.complete === undefined ? {} : { override: [options.complete] }),
    syntaxHighlighting(COLOURS),
    LOOK,
    ...(options.path.endsWith(".skill") ? [skillLanguage] : []),
    EditorState.readOnly.of(options.readOnly),
    EditorView.contentAttributes.of({ "aria-label": `Source of ${options.path}` }),
    EditorView.updateListener.of((update) => {
      if (update.docChanged) options.onChange(update.state.doc.toString());
    }),
    keymap.of([
      { key: "Mod-s", run: save },
      { key: "F9", run: toggleHere },
      ...completionKeymap,
      ...defaultKeymap,
      ...historyKeymap,
      ...searchKeymap,
      ...lintKeymap,
      ...(options.readOnly ? [] : [indentWithTab]),
    ]),
    options.extensions ?? [],
  ];
}

const COLOURS = HighlightStyle.define([
  { tag: tags.keyword, color: "var(--accent)" },
  { tag: tags.typeName, color: "var(--line3)" },
  { tag: tags.string, color: "var(--good)" },
  { tag: tags.link, color: "var(--good)" },
  { tag: tags.number, color: "var(--line2)" },
  { tag: tags.comment, color: "var(--muted)", fontStyle: "italic" },
]);

const LOOK = EditorView.theme({
  "&": { height: "100%", color: "var(--ink)", backgroundColor: "var(--panel)", fontSize: "12px" },
  // The caret and its line show that it has the keyboard; gutters would cover a frame.
  "&.cm-focused": { outline: "none" },
  ".cm-scroller": { fontFamily: "var(--mono)", lineHeight: "19px" },
  ".cm-content": { caretColor: "var(--ink)" },
  ".cm-cursor": { borderLeftColor: "var(--ink)" },
  ".cm-gutters": {
    color: "var(--muted)",
    backgroundColor: "var(--raised)",
    border: "none",
    borderRight: "1px solid var(--line)",
  },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "var(--hover)" },
  ".cm-chosen": { backgroundColor: "var(--selected)" },
  ".cm-running": { boxShadow: "inset 3px 0 var(--running)", backgroundColor: "var(--running-ground)" },
  ".cm-breakpoints": { width: "16px", cursor: "pointer" },
  ".cm-breakpoints .cm-gutterElement": { display: "flex", alignItems: "center", justifyContent: "center" },
  // Problems are triangles: a red disc is a breakpoint, and nothing else.
  ".cm-lint-marker": { width: "10px", height: "9px", clipPath: "polygon(50% 0, 100% 100%, 0 100%)" },
  ".cm-lint-marker-error": { content: "normal", backgroundColor: "var(--bad)" },
  ".cm-lint-marker-warning": { content: "normal", backgroundColor: "var(--waiting)" },
  ".cm-lint-marker-info": { content: "normal", backgroundColor: "var(--idle)" },
  ".cm-breakpoint": { width: "9px", height: "9px", borderRadius: "50%", backgroundColor: "var(--bad)" },
  "&.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground, ::selection": {
    backgroundColor: "var(--selected)",
  },
  ".cm-tooltip, .cm-panels": {
    color: "var(--ink)",
    backgroundColor: "var(--panel)",
    border: "1px solid var(--strong-line)",
  },
  ".cm-tooltip-autocomplete > ul > li[aria-selected]": {
    color: "var(--ink)",
    backgroundColor: "var(--selected)",
  },
  ".cm-diagnostic": { maxWidth: "480px", padding: "6px 10px", fontSize: "12px" },
  ".cm-diagnostic-error": { borderLeftColor: "var(--bad)" },
  ".cm-diagnosticAction": {
    margin: "4px 0 0",
    padding: "2px 8px",
    display: "block",
    font: "inherit",
    color: "var(--on-accent)",
    backgroundColor: "var(--accent)",
    borderRadius: "var(--radius)",
  },
  ".cm-hover-text": { maxWidth: "480px", padding: "6px 10px", whiteSpace: "pre-wrap", fontSize: "12px" },
  ".cm-searchMatch": { backgroundColor: "var(--waiting-ground)", outline: "1px solid var(--waiting)" },
});
