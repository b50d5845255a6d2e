"""Runs the functions of a list on their memories, again and again, as one call of machine code."""

from __future__ import annotations

from typing import Protocol, TypeAlias

import msgspec

from skillc_runtime.motion.arrays import Integers, OutVector
from skillc_runtime.motion.numerics.compiled import Bound, compiled
from skillc_runtime.motion.numerics.places import call_entry

NOW, LEFT, PHASE, ROW = range(4)
"""Entries of `Program.cursor`: s, when the present step began; steps that are left; number of the step in its control
period; the row where the program goes on."""

ROWS, CONTROL_ROWS, STEPS_PER_PERIOD = range(3)
"""Columns of `Program.extent`: how many rows there are, how many of them run in the first step of a period only."""

ASKS_PYTHON = 1 << 62
"""What a row without a function returns."""

NO_FUNCTION = (0, 0, 0)

Rows: TypeAlias = tuple[tuple[int, int, int], ...]
"""Rows of a `Program`: what a part computes in a step; none for a part that has nothing to do now."""

IDLE: Rows = ()


class Part(Protocol):
    """What takes part in each step of a cell; times in s."""

    @property
    def rows(self) -> Rows | None:
        """What it computes in a step, as things are now; None if only Python can do it."""
        ...

    def step(self, now: float) -> bool:
        """Do all of it for the step that begins at `now`; tell whether any `rows` may be others now."""
        ...

    def act(self, events: int, now: float) -> bool:
        """Do what is left after one of the rows has returned bits; tell whether any `rows` may be others now."""
        ...


def row_of(compute: Bound[[float], int]) -> Rows | None:
    """Return the row of a function with its memory; None without machine code."""
    return compute.rows


def join(*found: Rows | None) -> Rows | None:
    """Return all rows; None if only Python can do one of the things."""
    known = [each for each in found if each is not None]
    return sum(known, IDLE) if len(known) == len(found) else None


class Program(msgspec.Struct, frozen=True):
    """C functions (n, 3), a row each, that all run in each step: the address of a function and two arguments.

    With one argument, the address of its memory, it is called with the time in s as well, and returns what has happened
    as bits; with two, it returns nothing. extent (1, 3), cursor (4,): see above.
    """

    rows: Integers
    extent: Integers
    cursor: OutVector
    step_s: float


@compiled
def run_program(program: Program) -> int:
    """Run steps until none is left, or a function returns bits: these are returned, and the cursor stays at it."""
    rows, cursor = program.rows, program.cursor
    count, control, period = program.extent[0, ROWS], program.extent[0, CONTROL_ROWS], program.extent[0, 2]
    row, phase, left, now = int(cursor[ROW]), int(cursor[PHASE]), int(cursor[LEFT]), cursor[NOW]
    events = 0
    while left > 0:
        if phase != 0 and row < control:
            row = control
        while row < count and events == 0:
            function, first, second = rows[row, 0], rows[row, 1], rows[row, 2]
            if function == 0:
                events = ASKS_PYTHON
            elif second == 0:
                events = call_entry(function, first, now)
            else:
                call_entry(function, first, second)
            row += 1
        if events != 0:
            row -= 1
            break
        row, now, left = 0, now + program.step_s, left - 1
        phase = phase + 1 if phase + 1 < period else 0
    cursor[ROW], cursor[PHASE], cursor[LEFT], cursor[NOW] = row, phase, left, now
    return events
