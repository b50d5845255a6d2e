"""Primitives that do what no primitive may do: they block, leave or kill the process."""

from __future__ import annotations

import ctypes
import os
import re
import signal
import sys
import time

from skillc_runtime.primitives.primitive import Primitive, Status

FOR_EVER_S = 10**9


class Breaking(Primitive):
    """Breaks in its third tick."""

    def start(self) -> None:
        self._ticks = 0

    def tick(self) -> Status:
        self._ticks += 1
        if self._ticks == 3:
            self.break_down()
        return Status.RUNNING

    def break_down(self) -> None:
        raise NotImplementedError


class Sleeping(Breaking):
    def break_down(self) -> None:
        time.sleep(FOR_EVER_S)


class Locking(Breaking):
    """Blocks with the interpreter lock, as an extension module may."""

    def break_down(self) -> None:
        ctypes.PyDLL(None).sleep(FOR_EVER_S)


class Matching(Breaking):
    """Blocks in a regular expression that takes exponential time, with the interpreter lock."""

    def break_down(self) -> None:
        re.fullmatch(r"(a+)+b", "a" * 64)


class Leaving(Breaking):
    def break_down(self) -> None:
        os._exit(0)


class Exiting(Breaking):
    def break_down(self) -> None:
        sys.exit()


class Killed(Breaking):
    def break_down(self) -> None:
        os.kill(os.getpid(), signal.SIGKILL)
