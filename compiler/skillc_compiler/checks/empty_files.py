"""A file that contains only comments."""

from __future__ import annotations

import re
from collections.abc import Iterator

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span

NAMES = ("empty-file",)
NEEDS = Need.TEXT
READS = Reads.NEIGHBOURS
_NOTHING = re.compile(r"(?:\s|#[^\n]*+)*+")


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a warning for each empty file."""
    for unit in program.files:
        if _NOTHING.fullmatch(unit.text):
            yield Diagnostic(
                "empty-file",
                Span(unit.file.path, 1, 1, 1, 2),
                "this file is empty: it declares nothing",
                help="declare a skill, an implementation or a task in it, or remove it",
                severity="warning",
            )
