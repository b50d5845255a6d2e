// Made from the fields of what is requested of a cell by `python tests/accept.py`; do not edit.

export interface RunField {
  readonly name: string;
  readonly kind: "flag" | "number";
  /** What it does, as the help of the command line and the API say it. */
  readonly text: string;
}

export const RUN_FORM: readonly RunField[] = [
  {
    "name": "approve",
    "kind": "flag",
    "text": "Let each plan, also a new one, wait for approval."
  },
  {
    "name": "ask_after_failure",
    "kind": "flag",
    "text": "Let a failed step wait for a decision instead of another plan."
  },
  {
    "name": "deadline_s",
    "kind": "number",
    "text": "Let the task fail if it has not ended after these seconds of the cell's time; also limits planning."
  },
  {
    "name": "step_deadline_s",
    "kind": "number",
    "text": "Let a primitive or a wait fail if it has not ended after these seconds of the cell's time, without those that it was paused."
  },
  {
    "name": "step",
    "kind": "flag",
    "text": "Pause before the first call, and go on step by step."
  },
  {
    "name": "confirm_steps",
    "kind": "flag",
    "text": "Pause before each step, with the arms held, until somebody lets the task go on."
  },
  {
    "name": "speed",
    "kind": "number",
    "text": "Move arms and bases with this share of their speeds, above 0 to 1; forces stay as they are."
  },
  {
    "name": "priority",
    "kind": "number",
    "text": "Of those that wait for planners or devices, the higher comes first; nothing that runs gives way."
  }
];
