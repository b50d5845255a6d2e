"""The goals and calls of a manifest, and where their texts stand in it."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator

from skillc.services.project.project import MANIFEST, Project
from skillc_compiler.ide.project_names import NamedGoal

_QUOTED = re.compile(r"""[ \t"']*=[ \t]*("{3}|'{3}|["'])""")


def read_goals(project: Project) -> Iterator[NamedGoal | tuple[str, str]]:
    """Yield the goals and calls of a manifest; the name and text of one that is not written there as it reads."""
    text = project.source.text
    starts = [0, *(match.end() for match in re.finditer("\n", text))]
    for name, named in project.manifest.tasks.items():
        kind, written = ("goal", named.goal) if named.goal is not None else ("call", named.call or "")
        key = project.place_of("tasks", name, kind)
        quoted = _QUOTED.match(text, starts[key.end_line - 1] + key.end_column - 1)
        start = quoted.end() if quoted else 0
        start += text.startswith("\n", start) and not written.startswith("\n")
        if quoted is None or not text.startswith(written + quoted[1], start):
            yield name, written
            continue
        line = bisect_right(starts, start)
        yield NamedGoal("goal" if kind == "goal" else "do", written, MANIFEST, line, start - starts[line - 1] + 1)
