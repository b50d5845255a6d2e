// Two texts side by side with their differences marked; the right one can be changed, also by taking over a difference.
import { MergeView } from "@codemirror/merge";
import { EditorState } from "@codemirror/state";
import { EditorView } from "@codemirror/view";
import type { Conflict } from "../state/source";
import { editorBasics } from "./editor";

/** Show both texts of a conflict in an element. */
export function openMerge(parent: HTMLElement, { path, theirs, mine }: Conflict): MergeView {
  const label = (text: string) => EditorView.contentAttributes.of({ "aria-label": text });
  const merge = new MergeView({
    parent,
    a: {
      doc: theirs,
      extensions: [editorBasics(path), EditorState.readOnly.of(true), label(`${path} on disk`)],
    },
    b: { doc: mine, extensions: [editorBasics(path), label(`Your ${path}`)] },
    revertControls: "a-to-b",
    renderRevertControl: () => {
      const button = document.createElement("button");
      button.textContent = "→";
      button.title = "Take this over";
      button.setAttribute("aria-label", "Take this over");
      return button;
    },
    highlightChanges: true,
    gutter: true,
  });
  for (const view of [merge.a, merge.b]) view.scrollDOM.tabIndex = 0;
  return merge;
}
