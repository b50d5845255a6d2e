"""Primitives that end badly in their third tick."""

from __future__ import annotations

import sys

from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status


class Breaking(Primitive):
    """Runs for two ticks."""

    def start(self) -> None:
        self._ticks = 0

    def tick(self) -> Status:
        self._ticks += 1
        if self._ticks == 3:
            self.break_down()
        return Status.RUNNING

    def break_down(self) -> None:
        raise NotImplementedError


class Failing(Breaking):
    def break_down(self) -> None:
        raise SkillFailure("it fell")


class Exiting(Breaking):
    def break_down(self) -> None:
        sys.exit(0)


class Raising(Breaking):
    def break_down(self) -> None:
        raise LookupError("what was expected is missing")
