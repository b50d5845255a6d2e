// What the language server says beside a text: hints in its lines, and lenses above its declarations.
import { type Extension, StateEffect, StateField, type Text } from "@codemirror/state";
import { Decoration, type DecorationSet, EditorView, ViewPlugin, WidgetType } from "@codemirror/view";
import { offsetOf, positionOf } from "./edits";
import type { LanguageServer, LspLocation, LspPosition, LspRange } from "./language_server";

interface LspHint {
  position: LspPosition;
  label: string;
  tooltip?: string | { value: string };
}
interface LspLens {
  range: LspRange;
  command: { title: string; command: string; arguments: readonly unknown[] };
}
interface Annotations {
  hints: readonly LspHint[];
  lenses: readonly LspLens[];
}

/** The commands of lenses that the studio carries out. */
export const LENS_COMMANDS = ["skillc.run", "skillc.plan", "skillc.test", "skillc.showReferences"];
/** How long nothing is typed before the server is asked again. */
const PAUSE_MS = 300;

export interface LensActions {
  /** Choose a task of the library, and show its plan if it has a goal. */
  onTask: (name: string) => void;
  onReferences: (view: EditorView, title: string, places: readonly LspLocation[]) => void;
  /** Run a test of the text that is shown. */
  onTest: (name: string) => Promise<TestAnswer>;
}

/** Whether a test passed, with how long it took or what is wrong; `refused` is why it was not run. */
export type TestAnswer = { passed: boolean; said: string } | { refused: string };

class HintWidget extends WidgetType {
  constructor(
    private readonly text: string,
    private readonly about: string,
  ) {
    super();
  }

  override eq(other: HintWidget): boolean {
    return other.text === this.text && other.about === this.about;
  }

  override toDOM(): HTMLElement {
    const hint = document.createElement("span");
    hint.className = "cm-hint";
    hint.textContent = this.text;
    hint.title = this.about;
    return hint;
  }
}

class LensWidget extends WidgetType {
  constructor(
    private readonly indent: string,
    private readonly lenses: readonly LspLens[],
    private readonly actions: LensActions,
  ) {
    super();
  }

  override eq(other: LensWidget): boolean {
    return other.indent === this.indent && JSON.stringify(other.lenses) === JSON.stringify(this.lenses);
  }

  override get estimatedHeight(): number {
    return 19;
  }

  override toDOM(view: EditorView): HTMLElement {
    const row = document.createElement("div");
    row.className = "cm-lenses";
    row.append(this.indent, ...this.lenses.map((each) => this.makeButton(view, each)));
    return row;
  }

  override ignoreEvent(): boolean {
    return true;
  }

  private makeButton(view: EditorView, lens: LspLens): HTMLElement {
    const button = document.createElement("button");
    button.className = "cm-lens";
    button.textContent = lens.command.title;
    button.onclick = () => carryOut(view, button, lens, this.actions);
    return button;
  }
}

function carryOut(view: EditorView, button: HTMLElement, { command }: LspLens, actions: LensActions): void {
  if (command.command === "skillc.showReferences")
    return actions.onReferences(view, command.title, command.arguments[2] as LspLocation[]);
  const [what] = command.arguments as [{ arguments: string[] }];
  const name = what.arguments[1]?.split(":").at(-1) ?? "";
  if (command.command === "skillc.test") void showTest(button, actions.onTest(name));
  else actions.onTask(name);
}

/** Write beside a lens how its test went; that is gone once the text is changed. */
async function showTest(button: HTMLElement, asked: Promise<TestAnswer>): Promise<void> {
  const row = button.parentElement;
  clearTests(row);
  const said = document.createElement("span");
  said.role = "status";
  said.className = "cm-lens-result";
  row?.append(said);
  said.textContent = "running";
  const answer = await asked;
  const isGood = "passed" in answer && answer.passed;
  said.classList.add(isGood ? "good" : "bad");
  if ("refused" in answer) said.textContent = answer.refused;
  else said.textContent = `${answer.passed ? "passed" : "failed"}: ${answer.said}`;
}

function clearTests(within: Element | null): void {
  within?.querySelectorAll(".cm-lens-result").forEach((each) => {
    each.remove();
  });
}

const setAnnotations = StateEffect.define<DecorationSet>();

const annotations = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update: (before, transaction) =>
    transaction.effects.find((each) => each.is(setAnnotations))?.value ?? before.map(transaction.changes),
  provide: (field) => EditorView.decorations.from(field),
});

function decorate(doc: Text, { hints, lenses }: Annotations, actions: LensActions): DecorationSet {
  const lines = new Map<number, LspLens[]>();
  for (const each of lenses) {
    const { line } = each.range.start;
    if (line < doc.lines) lines.set(line, [...(lines.get(line) ?? []), each]);
  }
  const above = [...lines].map(([number, found]) => {
    const line = doc.line(number + 1);
    const indent = /^\s*/.exec(line.text)?.[0] ?? "";
    const widget = new LensWidget(indent, found, actions);
    return Decoration.widget({ widget, block: true, side: -1 }).range(line.from);
  });
  const inside = hints.map((each) => {
    const about = typeof each.tooltip === "string" ? each.tooltip : (each.tooltip?.value ?? "");
    const widget = new HintWidget(each.label, about.replaceAll("`", ""));
    return Decoration.widget({ widget, side: 1 }).range(offsetOf(doc, each.position));
  });
  return Decoration.set([...above, ...inside], true);
}

/** Ask for the hints and lenses of the text that is shown, and show them unless it has changed meanwhile. */
export async function annotate(
  server: LanguageServer,
  view: EditorView,
  actions: LensActions,
): Promise<void> {
  const { doc } = view.state;
  const range = { start: { line: 0, character: 0 }, end: positionOf(doc, doc.length) };
  const [hints, lenses] = await Promise.all([
    server.ask<LspHint[]>("textDocument/inlayHint", { range }),
    server.ask<LspLens[]>("textDocument/codeLens", {}),
  ]);
  if (view.state.doc !== doc) return;
  const found = { hints: hints ?? [], lenses: lenses ?? [] };
  view.dispatch({ effects: setAnnotations.of(decorate(doc, found, actions)) });
}

/** Show hints and lenses, which follow the text while it is changed, and are asked for again after that. */
export function annotated(server: LanguageServer, actions: LensActions): Extension {
  const asking = ViewPlugin.define((view) => {
    let timer = 0;
    return {
      update: (update) => {
        if (!update.docChanged) return;
        clearTests(view.dom);
        window.clearTimeout(timer);
        timer = window.setTimeout(() => void annotate(server, view, actions), PAUSE_MS);
      },
      destroy: () => window.clearTimeout(timer),
    };
  });
  return [annotations, asking, LOOK];
}

const LOOK = EditorView.theme({
  ".cm-hint": {
    color: "var(--muted)",
    backgroundColor: "var(--raised)",
    borderRadius: "var(--radius)",
    fontSize: "11px",
  },
  ".cm-lenses": { padding: "0 6px", lineHeight: "19px", whiteSpace: "pre" },
  ".cm-lens": {
    marginRight: "10px",
    padding: "0",
    border: "none",
    font: "inherit",
    fontSize: "11px",
    lineHeight: "inherit",
    color: "var(--muted)",
    background: "none",
    cursor: "pointer",
  },
  ".cm-lens-result": { fontSize: "11px", color: "var(--muted)" },
  ".cm-lens-result.good": { color: "var(--good)" },
  ".cm-lens-result.bad": { color: "var(--bad)", whiteSpace: "pre-wrap" },
  ".cm-lens:hover, .cm-lens:focus-visible": { color: "var(--accent)", textDecoration: "underline" },
});
