// The colours of the view, which are those of the page.
import * as three from "three";

export interface SceneTheme {
  isDark: boolean;
  ground: three.Color;
  ink: three.Color;
  accent: three.Color;
  /** What is only believed. */
  believed: three.Color;
  /** Contact forces, and where a tool is pressed. */
  force: three.Color;
  trail: three.Color;
  /** What a disturbance moves in reality. */
  disturb: three.Color;
}

/** Return the colours that apply to an element now. */
export function readTheme(element: HTMLElement): SceneTheme {
  const probe = document.createElement("span");
  element.append(probe);
  const read = (name: string): three.Color => {
    probe.style.color = `var(${name})`;
    return new three.Color(getComputedStyle(probe).color);
  };
  const ground = read("--scene-ground");
  const theme = {
    isDark: ground.getHSL({ h: 0, s: 0, l: 0 }).l < 0.5,
    ground,
    ink: read("--ink"),
    accent: read("--accent"),
    believed: read("--scene-believed"),
    force: read("--scene-force"),
    trail: read("--scene-trail"),
    disturb: read("--scene-disturb"),
  };
  probe.remove();
  return theme;
}

/** Call a function whenever the colours of the page change; the function that is returned ends that. */
export function onThemeChange(changed: () => void): () => void {
  const scheme = matchMedia("(prefers-color-scheme: dark)");
  const observer = new MutationObserver(changed);
  observer.observe(document.documentElement, { attributes: true, attributeFilter: ["data-theme"] });
  scheme.addEventListener("change", changed);
  return () => {
    observer.disconnect();
    scheme.removeEventListener("change", changed);
  };
}
