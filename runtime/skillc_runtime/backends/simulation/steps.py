"""Runs the steps of a cell: what takes part in them, in order, in machine code for as long as only numbers change.

Each part computes in one function on memory, which machine code and Python call alike, so that both ways give the same
to the last bit. What else there is to be done, the function only says, in bits; then Python does it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import accumulate

import msgspec
import numpy as np

from skillc_runtime.motion.arrays import Vector
from skillc_runtime.motion.numerics import program
from skillc_runtime.motion.numerics.compiled import COMPILES, Bound, bind, compiled
from skillc_runtime.motion.numerics.program import (
    ASKS_PYTHON,
    IDLE,
    NO_FUNCTION,
    Part,
    Program,
    Rows,
    row_of,
    run_program,
)

SOME_ROWS = 64
"""How many rows of a program there is room for at first."""


class OnMemory:
    """A part that is one function on memory; subclasses do what it asks for.

    is_fixed: whether it is the same function on the same memory for ever.
    """

    is_fixed = True

    def __init__(self, compute: Bound[[float], int], act: Callable[[int, float], bool] | None = None) -> None:
        self._compute = compute
        if act is not None:
            self.act = act  # type: ignore[assignment, method-assign]

    @property
    def rows(self) -> Rows | None:
        """The function."""
        return row_of(self._compute)

    def step(self, now: float) -> bool:
        """Compute, and act if asked to."""
        events = self._compute(now)
        return events != 0 and self.act(events, now)

    def act(self, events: int, now: float) -> bool:
        """Do nothing."""
        return False


class Due(msgspec.Struct, frozen=True):
    """When something has to be done next: due (1,), s."""

    due: Vector


@compiled
def is_due(memory: Due, now: float) -> int:
    """Return 1 from the step on in which something has to be done."""
    return 1 if now >= memory.due[0] else 0


class InPython:
    """A part that only Python can do, unless it has nothing to do now."""

    def __init__(self, step: Callable[[float], None], is_idle: Callable[[], bool] = lambda: False) -> None:
        self._step, self._is_idle = step, is_idle

    @property
    def rows(self) -> Rows | None:
        """Nothing while it is idle."""
        return IDLE if self._is_idle() else None

    def step(self, now: float) -> bool:
        """Do it."""
        if not self._is_idle():
            self._step(now)
        return True

    def act(self, events: int, now: float) -> bool:
        """Do nothing: no function asks for it."""
        return False


class ForItself(InPython):
    """As `InPython`, but what it does changes the rows of no other part before it has nothing more to do."""

    def step(self, now: float) -> bool:
        """Do it; tell whether it has nothing to do now."""
        super().step(now)
        return self._is_idle()


class Steps:
    """The steps of a cell, each of which runs all parts in order; those of `control` once in so many steps.

    runs_program: whether machine code runs what it can. Times in s.
    """

    def __init__(self, control: Sequence[Part], others: Sequence[Part], steps_per_period: int, step_s: float) -> None:
        self._parts, self._controlling = (*control, *others), len(control)
        self._extent = np.zeros((1, 3), dtype=np.int64)
        self._extent[0, program.STEPS_PER_PERIOD] = self._per_period = steps_per_period
        self._cursor, self._step_s, self._phase = np.zeros(4), step_s, 0
        self._make_table(SOME_ROWS)
        self._changing = [
            number for number, part in enumerate(self._parts) if not (isinstance(part, OnMemory) and part.is_fixed)
        ]
        self._found: list[Rows | None] = []
        self._starts, self._owners = [0], list[int]()
        self.runs_program = COMPILES

    def run(self, now: float, steps: int) -> None:
        """Run steps from `now` on; an exception of a part ends the step that it is in."""
        if self.runs_program:
            self._run_program(now, steps)
            return
        for _ in range(steps):
            first = self._controlling if self._phase else 0
            for part in self._parts[first:]:
                part.step(now)
            now, self._phase = now + self._step_s, (self._phase + 1) % self._per_period

    def _run_program(self, now: float, steps: int) -> None:
        cursor = self._cursor
        cursor[program.NOW], cursor[program.LEFT], cursor[program.PHASE] = now, steps, self._phase
        self._write()
        cursor[program.ROW] = 0
        try:
            while events := self._run():
                number = self._owners[int(cursor[program.ROW])]
                part, now = self._parts[number], float(cursor[program.NOW])
                if part.step(now) if events == ASKS_PYTHON else part.act(events, now):
                    self._write()
                cursor[program.ROW] = self._starts[number + 1]
        finally:
            self._phase = int(cursor[program.PHASE])

    def _make_table(self, rows: int) -> None:
        self._rows = np.zeros((rows, 3), dtype=np.int64)
        self._run = bind(run_program, Program(self._rows, self._extent, self._cursor, self._step_s))

    def _write(self) -> None:
        """Write the program as things are now."""
        if not self._found:
            self._found = [part.rows for part in self._parts]
            self._lay_out()
        parts, found, is_new = self._parts, self._found, False
        for number in self._changing:  # a loop, as in each tick
            rows = parts[number].rows
            if rows is not found[number]:
                found[number], is_new = rows, True
        if is_new:
            self._lay_out()

    def _lay_out(self) -> None:
        """Write the rows that were found, and the first one of each part, and of what would come after."""
        rows = [(NO_FUNCTION,) if each is None else each for each in self._found]
        self._starts = list(accumulate(map(len, rows), initial=0))
        self._owners = [number for number, each in enumerate(rows) for _ in each]
        written = [row for each in rows for row in each]
        if len(written) > len(self._rows):
            self._make_table(2 * len(written))
        self._rows[: len(written)] = np.array(written, dtype=np.int64).reshape(-1, 3)
        self._extent[0, : program.STEPS_PER_PERIOD] = len(written), self._starts[self._controlling]
