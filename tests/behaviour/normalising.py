"""What may differ between two saved behaviours: where files are, when and how long something ran, and its id."""

from __future__ import annotations

import re
from collections.abc import Mapping

RULES = tuple(
    (re.compile(pattern), instead)
    for pattern, instead in (
        (r"-\d{8}T\d{6}Z-[0-9a-f]{6}", "-<run>"),
        (r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?(Z|[+-]\d\d:\d\d)", "<moment>"),
        (r"\bfor \d+ s\b(?=\s)", "for <duration>"),  # what is left of a lease
        (r'("\w*_ns": ?)\d{15,}', r"\1<moment>"),
        (r'("(?:wall_time_s|real_time_factor|planning_time_s|uptime_s)": ?)[-+.\de]+', r"\1<duration>"),
        (
            r"(?m)^((checking|planning.*) \.\.|compiling the control laws.*|CP-SAT: a plan of .*)\n",
            "",
        ),  # if it takes long
        (r" at 0x[0-9a-f]+", ""),
        (r"http://127\.0\.0\.1:\d+", "<server>"),
        (r"\b[0-9a-f]{8}(-[0-9a-f]{4}){3}-[0-9a-f]{12}\b", "<id>"),
    )
)


def normalise(text: str, roots: Mapping[str, str]) -> str:
    """Replace what may differ; `roots` has the folders that are named in a text, with what to write instead."""
    for folder in sorted(roots, key=len, reverse=True):
        text = text.replace(folder, f"<{roots[folder]}>")
    for pattern, instead in RULES:
        text = pattern.sub(instead, text)
    return text
