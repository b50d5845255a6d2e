"""Reads breakpoints, and refuses those at which nothing could ever pause."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from difflib import get_close_matches

from skillc.errors import RequestError
from skillc_dsl.position import Position
from skillc_model.skills import Compound, SkillLibrary
from skillc_model.traversal import find_calls
from skillc_runtime.execution.tree.gate import AtLine, AtSkill, Breakpoint, Gate
from skillc_runtime.recording.run_spec import RunRequest

_LINE = re.compile(r"(?P<path>.+):(?P<line>\d{1,9})")
_SHOWN = 5
"""How many lines or files an error lists."""


def parse_breakpoints(texts: Iterable[str], library: SkillLibrary) -> tuple[Breakpoint, ...]:
    """Return the breakpoints that are written as SKILL or FILE:LINE.

    RequestError, with what there is near, for a skill that the library does not have, or a line without a call.
    """
    places = sorted(_find_calls(library))
    return tuple(
        _find_line(match["path"], int(match["line"]), places)
        if (match := _LINE.fullmatch(text))
        else _find_skill(text, library)
        for text in texts
    )


def make_gate(request: RunRequest, library: SkillLibrary) -> Gate:
    """Return the gate of a run, which pauses where that is requested; RequestError as of `parse_breakpoints`."""
    gate = Gate(parse_breakpoints(request.breakpoints, library), request.confirm_steps)
    if request.step:
        gate.step("into", ())
    return gate


def _find_skill(name: str, library: SkillLibrary) -> AtSkill:
    if name in library.skills:
        return AtSkill(name)
    near = get_close_matches(name, library.skills, n=_SHOWN)
    hint = f"did you mean {_join(near)}?" if near else "write the name of a skill, or FILE:LINE of a call"
    raise RequestError(f"breakpoint: there is no skill `{name}` in `{library.name}`; {hint}")


def _find_line(path: str, line: int, places: list[Position]) -> AtLine:
    files = sorted({place.path for place in places})
    named = [file for file in files if file == path] or [file for file in files if f"/{path}".endswith(f"/{file}")]
    found = named or [file for file in files if f"/{file}".endswith(f"/{path}")]
    if not found:
        near = get_close_matches(path, files, n=_SHOWN, cutoff=0.4) or files[:_SHOWN]
        raise RequestError(f"breakpoint: there are no calls in a file `{path}`; some files with calls: {_join(near)}")
    if len(found) > 1:
        raise RequestError(f"breakpoint: `{path}` may be {_join(found)}; write more of the path")
    lines = sorted({place.line for place in places if place.path == found[0]})
    if line not in lines:
        near_lines = sorted(sorted(lines, key=lambda each: abs(each - line))[:_SHOWN])
        shown = ", ".join(map(str, near_lines))
        raise RequestError(f"breakpoint: there is no call in line {line} of {found[0]}; the nearest are in {shown}")
    return AtLine(found[0], line)


def _find_calls(library: SkillLibrary) -> Iterator[Position]:
    """Yield the places of all calls in the bodies of implementations and tasks."""
    bodies = [each.body.node for each in library.implementations.values() if isinstance(each.body, Compound)]
    bodies += [task.body for task in library.tasks.values() if task.body is not None]
    return (call.source for body in bodies for call in find_calls(body))


def _join(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)
