"""A skill without an implementation."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("no-implementation",)
NEEDS = Need.PROGRAM
READS = Reads.NEIGHBOURS


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a warning for each skill that no implementation of the library can run."""
    for skill in program.skills.values():
        if not program.implementations_of[skill.name]:
            yield Diagnostic(
                "no-implementation",
                skill.name_span,
                f"the skill `{skill.name}` has no implementation, so it cannot run",
                help=f"add `impl NAME of {skill.name} {{ .. }}`",
                severity="warning",
            )
