// The keys of the page; they do nothing while somebody writes, but for the one that stops.
import { command, stop } from "../state/actions";
import { allows, mayCommand } from "../state/studio";
import {
  choosing,
  detailsTab,
  focusPanel,
  helpShown,
  maximised,
  nextTheme,
  PANELS,
  runTab,
  signalsTab,
  toggleMaximised,
  type PanelName,
} from "./layout";
import { togglePause } from "./TopBar";

function step(type: "step-into" | "step-over" | "step-out"): void {
  if (mayCommand() && allows(type)) void command({ type });
}

function showDetails(tab: typeof detailsTab.value): void {
  detailsTab.value = tab;
  requestAnimationFrame(() => focusPanel("details"));
}

function showRun(tab: typeof runTab.value): void {
  runTab.value = tab;
  requestAnimationFrame(() => focusPanel("run"));
}

const ACTIONS: Record<string, () => void> = {
  p: () => mayCommand() && togglePause(),
  n: () => step("step-over"),
  i: () => step("step-into"),
  o: () => step("step-out"),
  w: () => showDetails("why"),
  f: () => showDetails("world"),
  s: () => showDetails("source"),
  e: () => showDetails("events"),
  r: () => {
    choosing.value = true;
    showRun("run");
  },
  h: () => showRun("runs"),
  g: () => {
    signalsTab.value = signalsTab.value === "plan" ? "signals" : "plan";
    focusPanel("signals");
  },
  m: () => toggleMaximised(focusedPanel() ?? maximised.value ?? "tree"),
  t: nextTheme,
  "?": () => (helpShown.value = !helpShown.value),
  "/": () => search(),
};

function focusedPanel(): PanelName | null {
  const panel = document.activeElement?.closest<HTMLElement>("[data-panel]");
  return (panel?.dataset["panel"] as PanelName | undefined) ?? null;
}

/** Put the keyboard into the search of the panel that has it, or of the tree. */
function search(): void {
  const panel = document.querySelector(`[data-panel="${focusedPanel() ?? "tree"}"]`);
  const field = panel?.querySelector<HTMLElement>('input[type="search"]');
  (field ?? document.querySelector<HTMLElement>(".filter"))?.focus();
}

/** Let the panel have the keyboard instead of a field in it. */
function leaveField(): void {
  const panel = document.activeElement?.closest<HTMLElement>("[data-panel]");
  if (panel) panel.focus({ preventScroll: true });
  else focusPanel("tree");
}

/** Stop the cell, before anything else hears of the key: by `x` unless a text is written, and by Ctrl-Shift-X always. */
export function handleStop(event: KeyboardEvent): void {
  if (!isStop(event)) return;
  event.preventDefault();
  event.stopPropagation();
  if (!event.repeat) void stop();
}

function isStop(event: KeyboardEvent): boolean {
  const isOther = event.code === "KeyX" && event.key > "~"; // The same key of a keyboard without Latin letters.
  if (event.altKey || !(isOther || event.key.toLowerCase() === "x")) return false;
  return event.ctrlKey || event.metaKey ? event.shiftKey : !takesText(event);
}

export function handleKey(event: KeyboardEvent): void {
  if (event.key === "Escape" && helpShown.value) return void (helpShown.value = false);
  if (event.key === "Escape" && isWriting(event)) return leaveField();
  if (event.ctrlKey || event.metaKey || event.altKey || isWriting(event)) return;
  const panel = PANELS[Number(event.key) - 1];
  const act = panel === undefined ? ACTIONS[event.key] : () => focusPanel(panel);
  if (act === undefined) return;
  event.preventDefault();
  act();
}

/** Whether a key is for what has the keyboard: a text, a number, or a choice. */
function isWriting(event: KeyboardEvent): boolean {
  const target = event.composedPath()[0];
  return (
    takesText(event) ||
    target instanceof HTMLSelectElement ||
    (target instanceof HTMLInputElement && target.type !== "checkbox")
  );
}

const TEXTS = ["text", "search", "password", "email", "tel", "url"];

/** Whether a letter would be written into a text. */
function takesText(event: KeyboardEvent): boolean {
  const target = event.composedPath()[0];
  if (!(target instanceof HTMLElement)) return false;
  return (
    target.isContentEditable ||
    target instanceof HTMLTextAreaElement ||
    (target instanceof HTMLInputElement && TEXTS.includes(target.type))
  );
}
