"""Compares the packets between a client and a robot with the published limits of the robot."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field

import numpy as np

from robots.franka import limits

TAU, FINISHED, COMMAND = slice(314, 370), 370, 371
EFFORT, Q, DQ = slice(512, 540), slice(596, 624), slice(652, 680)


@dataclass
class Report:
    """What has passed, and what was beyond limits."""

    commands: int = 0
    states: int = 0
    dropped: int = 0
    longest_gap: int = 0
    greatest_torque: list[float] = field(default_factory=lambda: [0.0] * 7)
    greatest_step: float = 0.0
    greatest_speed_share: float = 0.0
    violations: list[str] = field(default_factory=list)

    def blame(self, what: str) -> None:
        if len(self.violations) < 20:
            self.violations.append(what)


class Checker:
    """Compares commands and measurements with the published limits."""

    def __init__(self, report: Report) -> None:
        self._report = report
        self.begin()

    def begin(self) -> None:
        self._last, self._last_number, self._silent = np.zeros(7), None, 0

    def see_state(self, packet: bytes) -> bool:
        """Check a state; return whether too many have had no command."""
        self._report.states += 1
        self._silent += 1
        self._report.longest_gap = max(self._report.longest_gap, self._silent - 1)
        q, dq = (np.frombuffer(packet[each], dtype="<f4") for each in (Q, DQ))
        if self._report.states % 8 == 0:
            low, high = limits.fastest(q)
            share = float(np.where(dq > 0, dq / np.maximum(high, 1e-3), dq / np.minimum(low, -1e-3)).max())
            self._report.greatest_speed_share = max(self._report.greatest_speed_share, share)
            if share > 1.0:
                self._report.blame(f"speed {dq.tolist()} at {q.tolist()}")
            if (q < limits.LOWEST).any() or (q > limits.HIGHEST).any():
                self._report.blame(f"posture {q.tolist()}")
        return self._silent > limits.LOST_IN_ROW

    def see_command(self, packet: bytes) -> None:
        report = self._report
        report.commands += 1
        self._silent = 0
        if len(packet) != COMMAND:
            report.blame(f"a command of {len(packet)} bytes")
            return
        if packet[FINISHED]:
            return
        (number,), tau = struct.unpack_from("<Q", packet), np.frombuffer(packet[TAU])
        if not np.isfinite(tau).all() or (np.abs(tau) > limits.TORQUE).any():
            report.blame(f"torque {tau.tolist()}")
        step = float(np.abs(tau - self._last).max())
        periods = 1 if self._last_number is None else max(number - self._last_number, 1)
        if step > limits.TORQUE_PER_MS * periods + 1e-6:
            report.blame(f"torque changes by {step:.3f} N m in {periods} ms")
        report.greatest_step = max(report.greatest_step, step / periods)
        report.greatest_torque = np.maximum(report.greatest_torque, np.abs(tau)).tolist()
        self._last, self._last_number = tau.copy(), number
