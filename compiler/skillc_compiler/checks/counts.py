"""A number of rounds that is not a whole number above zero.

Bad:

    skill Rest { noplan }
    impl patient of Rest { do repeat 0 { wait 1 s } }

Good:

    skill Rest { noplan }
    impl patient of Rest { do repeat 3 { wait 1 s } }
"""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program import Program
from skillc_compiler.walk import steps
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic

NAMES = ("bad-count",)


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a problem for each count of `retry`, `repeat` and `while .. max`."""
    for step in steps(program):
        match step.written:
            case s.Counted(count=count) | s.While(limit=count):
                if count.value < 1 or count.value != int(count.value):
                    yield Diagnostic(
                        "bad-count",
                        count.span,
                        f"`{count.text}` is no number of rounds",
                        help="write a whole number, 1 or more",
                    )
            case _:
                pass
