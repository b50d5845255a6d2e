// The controls of the view: where from, what is shown, and what the mouse does.
import type { ReadonlySignal } from "@preact/signals";
import type { CameraPreset, Reality, SceneActions, SceneOptions, Tool } from "./types";

const PRESETS: readonly [CameraPreset, string, string][] = [
  ["fit", "Fit", "Show the robots and what they work on, or what is selected"],
  ["front", "Front", "Look along y"],
  ["side", "Side", "Look against x"],
  ["top", "Top", "Look down"],
  ["follow", "Follow", "Follow the tool"],
];
/** What can be shown of a simulation, and of real devices, of which nothing but what they measure is known. */
const SIMULATED: readonly [Reality, string][] = [
  ["both", "True, belief as ghost"],
  ["true", "True only"],
  ["believed", "As believed"],
  ["beside", "Side by side"],
];
const MEASURED: readonly [Reality, string][] = [
  ["both", "Measured, command as ghost"],
  ["true", "Measured only"],
];
const SWITCHES: readonly [Exclude<keyof SceneOptions, "reality">, string, string][] = [
  ["labels", "Names", "Names of things"],
  ["frames", "Frames", "Frames of things and tools: x red, y green, z blue"],
  ["trails", "Trails", "The ways of tools; in another colour while pressed"],
  ["forces", "Forces", "Contact forces, 1 cm for each newton"],
  ["coverage", "Coverage", "Where tools have really worked"],
];

const TOOLS: readonly [Tool, string, string][] = [
  ["select", "Select", "Click a thing to select it"],
  ["measure", "Measure", "Click two points"],
  ["disturb", "Move in reality", "Move a thing in the simulated reality: a disturbance"],
  ["correct", "Correct belief", "Say where a thing is: an edit of the world model"],
];

/** What is shown at first. */
export const START: SceneOptions = {
  reality: "both",
  labels: true,
  frames: false,
  trails: true,
  forces: true,
  coverage: true,
};

export interface ToolbarProps {
  options: ReadonlySignal<SceneOptions>;
  tool: ReadonlySignal<Tool>;
  follows: ReadonlySignal<boolean>;
  refusals: SceneActions["refusals"];
  isReal: SceneActions["isReal"];
  onCamera: (preset: CameraPreset) => void;
  onOptions: (options: Partial<SceneOptions>) => void;
  onTool: (tool: Tool) => void;
}

export function Toolbar(props: ToolbarProps) {
  const { options, tool, follows } = props;
  const refusals: Partial<Record<Tool, string>> = props.refusals.value;
  return (
    <div class="scene-toolbar" role="toolbar" aria-label="3-D view">
      <div class="scene-group" role="group" aria-label="View">
        {PRESETS.map(([preset, text, title]) => (
          <button
            key={preset}
            type="button"
            title={title}
            aria-pressed={preset === "follow" ? follows.value : undefined}
            onClick={() => props.onCamera(preset)}
          >
            {text}
          </button>
        ))}
      </div>
      <div class="scene-group" role="group" aria-label="Mouse">
        {TOOLS.map(([name, text, title]) => (
          <button
            key={name}
            type="button"
            title={refusals[name] || title}
            disabled={Boolean(refusals[name])}
            class={`tool-${name}`}
            aria-pressed={tool.value === name}
            onClick={() => props.onTool(name)}
          >
            {text}
          </button>
        ))}
      </div>
      <details class="scene-menu">
        <summary>Show</summary>
        <div class="scene-sheet">
          <fieldset>
            <legend>Reality</legend>
            {(props.isReal.value ? MEASURED : SIMULATED).map(([reality, text]) => (
              <label key={reality}>
                <input
                  type="radio"
                  name="scene-reality"
                  checked={options.value.reality === reality}
                  onChange={() => props.onOptions({ reality })}
                />
                {text}
              </label>
            ))}
          </fieldset>
          <fieldset>
            <legend>Also</legend>
            {SWITCHES.map(([name, text, title]) => (
              <label key={name} title={title}>
                <input
                  type="checkbox"
                  checked={options.value[name]}
                  onChange={(event) => props.onOptions({ [name]: event.currentTarget.checked })}
                />
                {text}
              </label>
            ))}
          </fieldset>
        </div>
      </details>
    </div>
  );
}
