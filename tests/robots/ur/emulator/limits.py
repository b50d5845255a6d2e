"""What the controller checks: commands against the limits of a UR5e, and motion against its safety settings."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field
from math import pi

import numpy as np

from robots.ur.emulator.plant import STEP_S
from skillc_runtime.motion.pose import Array

JOINT_RANGE = 2.0 * pi
"""rad: data sheet of the UR5e."""

JOINT_SPEED = pi
"""rad/s: data sheet of the UR5e, 180 deg/s."""

JOINT_ACCELERATION = 40.0
"""rad/s^2: the greatest that the client library accepts for motions; the maker states none."""

TOOL_SPEED, TOOL_FORCE = 1.5, 150.0
"""m/s and N: factory settings of the robot limits of the safety system, e-Series user manual."""

START_STEP = 0.02
"""rad: how far the first target of a servo motion may be from the joint."""


WINDOW = 8
"""Speeds are those over so many targets: packages of a network arrive a cycle too early or too late."""


@dataclass
class Limits:
    """Remembers the last targets, and all that was beyond a limit."""

    violations: list[str] = field(default_factory=list)
    commands: int = 0
    most: dict[str, float] = field(default_factory=dict)
    _targets: deque[tuple[int, Array]] = field(default_factory=lambda: deque(maxlen=2 * WINDOW + 1))

    def start(self) -> None:
        """Forget the last targets: a servo motion begins."""
        self._targets.clear()

    def check_target(self, cycle: int, q: Array, present: Array) -> str | None:
        """Check a new target (6,) in rad of `servoj`, in a cycle of the controller; return what it exceeds."""
        self.commands += 1
        if not np.isfinite(q).all() or np.abs(q).max() > JOINT_RANGE:
            return self._note(f"joint target out of range: {q.tolist()}")
        self._targets.append((cycle, q))
        if len(self._targets) == 1:
            return self._compare("first step", np.abs(q - present).max(), START_STEP)
        step = np.abs(q - self._targets[-2][1]).max()
        problem = self._compare("step", step, 4.0 * JOINT_SPEED * STEP_S)
        if problem is None and len(self._targets) > 2 * WINDOW:
            (before, dq_before), (after, dq) = self._speed(0), self._speed(WINDOW)
            rise = float(np.abs(dq - dq_before).max()) / max(after - before, WINDOW * STEP_S)
            problem = self._compare("speed", float(np.abs(dq).max()), JOINT_SPEED)
            problem = problem or self._compare("acceleration", rise, JOINT_ACCELERATION)
        return problem

    def _speed(self, first: int) -> tuple[float, Array]:
        """Return the speed (6,) over a window of targets, and when that was, in s."""
        (before, q_before), (after, q) = self._targets[first], self._targets[first + WINDOW]
        past = max(after - before, WINDOW) * STEP_S
        return (after + before) / 2.0 * STEP_S, (q - q_before) / past

    def check_motion(self, dq: Array, tool_speed: float, force: float) -> str | None:
        """Check what is measured: joint speeds (6,), the speed of the tool in m/s, and the force on it in N."""
        return (
            self._compare("measured joint speed", float(np.abs(dq).max()), 1.06 * JOINT_SPEED)
            or self._compare("measured tool speed", tool_speed, TOOL_SPEED)
            or self._compare("measured tool force", force, TOOL_FORCE)
        )

    def _compare(self, what: str, value: float, most: float) -> str | None:
        self.most[what] = max(self.most.get(what, 0.0), float(value))
        return self._note(f"{what} {value:.3f} above {most:.3f}") if value > most else None

    def _note(self, problem: str) -> str:
        self.violations.append(problem)
        return problem
