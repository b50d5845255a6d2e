// How the page is divided: sizes of the panels, the one that is enlarged, the tabs, and the theme; kept in the browser.
import { computed, effect, signal } from "@preact/signals";

export const PANELS = ["run", "tree", "details", "scene", "signals"] as const;
export type PanelName = (typeof PANELS)[number];

export interface Sizes {
  /** Width of the left column without what a wide window adds, px. */
  left: number;
  /** Share of the middle column in what is left, and of the upper panels in the height. */
  middle: number;
  upper: number;
  scene: number;
}
export const DEFAULT_SIZES: Sizes = { left: 300, middle: 0.5, upper: 0.56, scene: 0.6 };

function kept<T>(name: string, otherwise: T) {
  const value = signal<T>(read(name, otherwise));
  effect(() => {
    try {
      localStorage.setItem(`studio.${name}`, JSON.stringify(value.value));
    } catch {
      // A browser that keeps nothing still shows the page.
    }
  });
  return value;
}

function read<T>(name: string, otherwise: T): T {
  try {
    const text = localStorage.getItem(`studio.${name}`);
    return text === null ? otherwise : (JSON.parse(text) as T);
  } catch {
    return otherwise;
  }
}

export const sizes = kept<Sizes>("sizes", DEFAULT_SIZES);
export const theme = kept<"system" | "light" | "dark">("theme", "system");
export const runTab = signal<"run" | "runs" | "jobs">("run");
export const detailsTab = signal<"why" | "world" | "source" | "events">("why");
export const signalsTab = kept<"signals" | "plan">("signalsTab", "signals");
export const maximised = signal<PanelName | null>(null);
/** Whether a person chooses something new although an operation is shown. */
export const choosing = signal(false);
/** The name of the task that is to be chosen as soon as the skills of the cell are known. */
export const wantedTask = signal<string | null>(null);
export const helpShown = signal(false);

effect(() => {
  if (theme.value === "system") delete document.documentElement.dataset["theme"];
  else document.documentElement.dataset["theme"] = theme.value;
});

const prefersDark = matchMedia("(prefers-color-scheme: dark)");
const systemIsDark = signal(prefersDark.matches);
prefersDark.addEventListener("change", (event) => (systemIsDark.value = event.matches));

/** Whether the page is dark now, for what is drawn and knows no variables. */
export const isDark = computed(() =>
  theme.value === "system" ? systemIsDark.value : theme.value === "dark",
);

export function toggleMaximised(name: PanelName): void {
  maximised.value = maximised.value === name ? null : name;
}

export function nextTheme(): void {
  const order = ["system", "light", "dark"] as const;
  theme.value = order[(order.indexOf(theme.value) + 1) % order.length] ?? "system";
}

/** Put the keyboard into a panel. */
export function focusPanel(name: PanelName): void {
  if (maximised.value !== null && maximised.value !== name) maximised.value = name;
  const panel = document.querySelector<HTMLElement>(`[data-panel="${name}"]`);
  (panel?.querySelector<HTMLElement>("[data-focus]") ?? panel)?.focus({ preventScroll: true });
}
