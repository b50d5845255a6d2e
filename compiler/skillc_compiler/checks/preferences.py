"""Preferences that are too large."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.checks.counts import MOST
from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("bad-number",)
NEEDS = Need.TEXT
READS = Reads.WRITTEN


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each `prefer` with a number beyond all others."""
    declared = (each for unit in program.files for each in unit.file.declarations)
    for declaration in (each for each in declared if isinstance(each, s.ImplementationDeclaration)):
        for member in declaration.members:
            if isinstance(member, s.Prefer) and abs(member.value.value) > MOST:
                yield Diagnostic("bad-number", member.value.span, "this number is too large", "write a smaller number")
