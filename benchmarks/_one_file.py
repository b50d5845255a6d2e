"""The shipped library as one file of any length, for benchmarks of the editor."""

from __future__ import annotations

import re

from compile import generated

_HEADER = re.compile(r"^(use|import) .*\n", re.MULTILINE)
_TASK = re.compile(r"^(?:## .*\n)*task .*?^}\n", re.MULTILINE | re.DOTALL)


def one_file(lines: int) -> str:
    """Return the shipped library without its tasks as one file, with copies until it has so many lines."""
    parts = [source.text for source in generated(lines + 200) if not source.path.startswith("tasks")]
    used = sorted({name.strip() for part in parts for line in _uses(part) for name in line.split(",")})
    text = f"use {', '.join(used)}\n" + "".join(_TASK.sub("", _HEADER.sub("", part)) for part in parts)
    rows = text.split("\n")
    last = next(number for number in range(lines, len(rows)) if rows[number - 1] == "}")
    return "\n".join((*rows[:last], ""))


def _uses(text: str) -> list[str]:
    return re.findall(r"^use (.*)$", text, re.MULTILINE)
