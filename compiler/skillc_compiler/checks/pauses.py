"""A time to keep the force in a skill that is never paused."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_dsl.diagnostics import Diagnostic, Fix

NAMES = ("keep-without-pause",)
NEEDS = Need.TEXT
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each `pause never` with a `keep`."""
    for skill in program.skills.values():
        pause = skill.pause
        if pause and pause.where == "never" and pause.keep:
            message = f"`{skill.name}` is never paused, so there is no pause in which a tool could go on pressing"
            help_ = "delete `keep` and its time, or say where it may be paused: `anywhere` or `between steps`"
            fix = Fix(pause.span, "pause never", "delete the time", safe=False)
            yield Diagnostic("keep-without-pause", pause.keep.span, message, help_, fix=fix)
