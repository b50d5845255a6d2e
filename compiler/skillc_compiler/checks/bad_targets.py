"""Texts that name nothing in a Python module."""

from __future__ import annotations

import re
from collections.abc import Iterator

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("bad-python-target",)
NEEDS = Need.TEXT
READS = Reads.WRITTEN
_TARGET = re.compile(r"([A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*):([A-Za-z_]\w*)")


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each target that is not of the form `package.module:Name`."""
    for target in _targets(program):
        if split_target(target.value) is None:
            message = f'"{target.value}" does not name something in a Python module'
            yield Diagnostic("bad-python-target", target.span, message, 'write "package.module:Name"')


def split_target(text: str) -> tuple[str, str] | None:
    """Return the module and the name in it; None if the text has another form."""
    found = _TARGET.fullmatch(text)
    return (found[1], found[2]) if found else None


def _targets(program: Program) -> Iterator[s.Text]:
    for declaration in (each for unit in program.files for each in unit.file.declarations):
        match declaration:
            case s.ImplementationDeclaration(members=members):
                yield from (member.target for member in members if isinstance(member, s.RunPython))
            case s.FunctionDeclaration(python=target):
                yield target
            case _:
                pass
