"""A Python target that is not written `module:name`.

Bad::

    run python "my_robot.pick.Pick"

Good::

    run python "my_robot.pick:Pick"
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from skillc_compiler.program import Program
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("bad-python-target",)
_TARGET = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*:[A-Za-z_]\w*")


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each target of another form; whether it exists is found out where it runs."""
    for implementation in program.implementations:
        if isinstance(implementation.body, s.RunPython):
            yield from _target(implementation.body.target)
    for unit in program.files:
        for declaration in unit.file.declarations:
            if isinstance(declaration, s.FunctionDeclaration):
                yield from _target(declaration.python)


def _target(written: s.Text) -> Iterator[Diagnostic]:
    if not _TARGET.fullmatch(written.value):
        yield Diagnostic(
            "bad-python-target",
            written.span,
            f'"{written.value}" does not name something in a Python module',
            help='write "package.module:Name"',
        )
