"""Primitives that do what no primitive may do: they block, leave or kill the process."""

from __future__ import annotations

import ctypes
import os
import re
import signal
import sys
import time

import numpy as np

from skillc_runtime.devices.cell import Cell
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.primitive import Primitive, Status

FOR_EVER_S = 10**9


class Swinging(Primitive):
    """Moves the tool by 20 cm in four seconds."""

    def __init__(self, cell: Cell, *, arm: str) -> None:
        super().__init__(cell)
        self._arm = cell.arm(arm)

    def start(self) -> None:
        begin = self._arm.motion.stopping_pose()
        end = Pose(begin.position + np.array([0.0, 0.2, 0.0]), begin.rotation)
        self._arm.motion.move_along(path_through([begin, end], MotionLimits(speed=0.05, acceleration=0.5)))

    def tick(self) -> Status:
        return Status.SUCCESS if self._arm.motion.done else Status.RUNNING

    def halt(self, reason: str) -> None:
        self._arm.motion.stop()


class Breaking(Primitive):
    """Breaks after half a second."""

    def start(self) -> None:
        self._breaks_at = self.cell.now + 0.5

    def tick(self) -> Status:
        if self.cell.now > self._breaks_at:
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
