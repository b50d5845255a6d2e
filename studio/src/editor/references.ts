// The references of a name: a panel below the text with a button for each place.
import { type Extension, StateEffect, StateField } from "@codemirror/state";
import { EditorView, keymap, type Panel, showPanel } from "@codemirror/view";
import type { Position } from "../api/types";
import { positionOf } from "./edits";
import type { LanguageServer, LspLocation } from "./language_server";

interface Found {
  title: string;
  /** The places; those in files that pages cannot read are not of the scheme `skill`. */
  places: readonly LspLocation[];
}

const setFound = StateEffect.define<Found | null>();

/** Show places below the text. */
export function showReferences(view: EditorView, title: string, places: readonly LspLocation[]): void {
  view.dispatch({ effects: setFound.of({ title, places }) });
  view.dom.querySelector<HTMLElement>(".cm-references button")?.focus();
}

/** Ask for the references of the name at the cursor, and show them (Shift-F12); `onGo` opens one. */
export function references(server: LanguageServer, onGo: (place: Position) => void): Extension {
  const field = StateField.define<Found | null>({
    create: () => null,
    update: (before, transaction) => {
      const effect = transaction.effects.find((each) => each.is(setFound));
      return effect === undefined ? before : effect.value;
    },
    provide: (found) =>
      showPanel.from(found, (value) => value && ((view) => makePanel(view, value, server, onGo))),
  });
  const find = (view: EditorView): boolean => {
    const position = positionOf(view.state.doc, view.state.selection.main.head);
    const context = { includeDeclaration: true };
    void server.ask<LspLocation[]>("textDocument/references", { position, context }).then((places) => {
      if (places !== null) showReferences(view, `${places.length} places`, places);
    });
    return true;
  };
  return [field, keymap.of([{ key: "Shift-F12", run: find }]), LOOK];
}

function makePanel(
  view: EditorView,
  { title, places }: Found,
  server: LanguageServer,
  onGo: (place: Position) => void,
): Panel {
  const dom = document.createElement("div");
  dom.className = "cm-references";
  dom.role = "region";
  dom.ariaLabel = title;
  const close = (): void => {
    view.dispatch({ effects: setFound.of(null) });
    view.focus();
  };
  dom.onkeydown = (event) => {
    if (event.key !== "Escape") return;
    event.stopPropagation();
    close();
  };
  const buttons = places.map((each) => {
    const place = server.placeOf(each);
    const isShown = each.uri.startsWith("skill:");
    const name = isShown ? place.path : (each.uri.split("/").at(-1) ?? "");
    return makeButton(`${name}:${place.line}`, isShown ? () => onGo(place) : null);
  });
  const heading = document.createElement("span");
  heading.textContent = title;
  dom.append(heading, ...buttons, makeButton("Close", close));
  return { dom };
}

function makeButton(text: string, onClick: (() => void) | null): HTMLButtonElement {
  const button = document.createElement("button");
  button.textContent = text;
  button.disabled = onClick === null;
  if (onClick === null) button.title = "Pages cannot show this file";
  else button.onclick = onClick;
  return button;
}

const LOOK = EditorView.theme({
  ".cm-references": {
    display: "flex",
    flexWrap: "wrap",
    gap: "4px 8px",
    alignItems: "center",
    maxHeight: "110px",
    padding: "6px 10px",
    overflowY: "auto",
    fontSize: "12px",
  },
  ".cm-references button": { fontFamily: "var(--mono)", fontSize: "11px" },
});
