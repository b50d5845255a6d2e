"""An angle of more than two turns, which was probably meant in degrees."""

from __future__ import annotations

import math
from collections.abc import Iterator

from skillc_compiler.program.marks import Need
from skillc_compiler.program.parts import Reads
from skillc_compiler.program.program import Program
from skillc_compiler.program.types import Measure
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.units import ANGLE
from skillc_model.conditions import Literal

NAMES = ("suspicious-angle",)
NEEDS = Need.NAMES
READS = Reads.DECLARATION


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield a warning for each constant angle of more than two turns."""
    for value in program.values:
        match value.meaning:
            case Literal(value=float(angle)) if value.type == Measure(ANGLE) and abs(angle) > 4 * math.pi:
                yield Diagnostic(
                    "suspicious-angle",
                    value.span,
                    f"this angle is {abs(angle) / (2 * math.pi):.1f} turns",
                    help="was it meant in `deg`?",
                    severity="warning",
                )
            case _:
                pass
