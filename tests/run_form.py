"""The form of the studio with which something is started: `python tests/accept.py` writes its fields."""

from __future__ import annotations

import json
from pathlib import Path

from msgspec import inspect

from skillc_runtime.recording.documented import documented_fields
from skillc_runtime.recording.run_spec import EXECUTION, RunRequest

FILE = Path(__file__).parents[1] / "studio/src/api/run_form.ts"
HEAD = """// Made from the fields of what is requested of a cell by `python tests/accept.py`; do not edit.

export interface RunField {
  readonly name: string;
  readonly kind: "flag" | "number";
  /** What it does, as the help of the command line and the API say it. */
  readonly text: string;
}

export const RUN_FORM: readonly RunField[] = """


def format_form() -> str:
    """Return the text of the file: flags and numbers; a breakpoint is set where the skills are shown."""
    fields = [
        {"name": each.name, "kind": "flag" if isinstance(each.type, inspect.BoolType) else "number", "text": each.text}
        for each in documented_fields(RunRequest)
        if each.section == EXECUTION and isinstance(each.type, inspect.BoolType | inspect.FloatType | inspect.IntType)
    ]
    return f"{HEAD}{json.dumps(fields, indent=2)};\n"
