"""What the control processes of a cell have published in each cycle, as live signals for recordings and displays."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from time import monotonic

import numpy as np

from skillc_runtime.backends.control_process.memory_plan import TIME
from skillc_runtime.backends.control_process.remote.control_watch import ControlWatch
from skillc_runtime.backends.control_process.remote.host import ControlProcess
from skillc_runtime.devices.live import NO_BODIES, LiveArm, LiveBodies, LiveSignals, ReadBytes
from skillc_runtime.motion.pose import Array, Pose

AWAY_PERIODS = 10
"""Times of cycles are a period apart, unless one is so many periods away from that."""


@dataclass(frozen=True, slots=True)
class FedArm:
    """An arm with its process, the pose of its base in the world, and whether it has a force-torque sensor."""

    process: ControlProcess
    base: Callable[[], Pose]
    feels_force: bool


class CycleFeed:
    """Hands over the cycles of all arms to the listeners of `live`; the fastest arm counts the time.

    `begin` says when the time of the cell is 0, in s of the machine's clock.
    """

    def __init__(self, arms: Mapping[str, FedArm], bodies: LiveBodies = NO_BODIES) -> None:
        self._arms, self._began, self._time = arms, monotonic(), -np.inf
        self._watches = {each: ControlWatch(arm.process) for each, arm in arms.items()}
        self._rows = {each: np.full(arm.process.ring.width, np.nan) for each, arm in arms.items()}
        self._leading = min(arms, key=lambda each: arms[each].process.connected.period_s)
        self._period_s = arms[self._leading].process.connected.period_s
        described = tuple(self._describe(each, arms[each]) for each in sorted(arms))
        self.live = LiveSignals(self._period_s, self._find_time, described, bodies=bodies, refresh=self.hand_over)

    def begin(self, began_s: float) -> None:
        """Let the time of the cell be 0 at a time of the machine's clock in s."""
        self._began = began_s

    def hand_over(self) -> None:
        """Call the listeners for each cycle since the last call; what has happened long ago is left out."""
        waiting = {each: self._take(each, arm) for each, arm in self._arms.items()}
        if not self.live.listeners:
            self._keep_last(waiting)
            return
        taken = dict.fromkeys(waiting, 0)
        for row in waiting[self._leading]:
            for each, rows in waiting.items():
                taken[each] = self._advance(each, rows, taken[each], float(row[TIME]))
            due = self._time + self._period_s
            self._time = due if abs(row[TIME] - due) < AWAY_PERIODS * self._period_s else float(row[TIME])
            for listen in tuple(self.live.listeners):
                listen()

    def _take(self, individual: str, arm: FedArm) -> Array:
        """Return the waiting cycles of an arm; what was before the time of the cell is left out."""
        rows = arm.process.ring.take()
        self._watches[individual].take(rows)
        return rows[rows[:, TIME] >= self._began]

    def _advance(self, individual: str, rows: Array, first: int, until_s: float) -> int:
        """Show the last row of an arm until then, from the row `first` on; return the number of the one after it."""
        while first < len(rows) and rows[first, TIME] <= until_s:
            self._rows[individual][:] = rows[first]
            first += 1
        return first

    def _keep_last(self, waiting: Mapping[str, Array]) -> None:
        for each, rows in waiting.items():
            if len(rows):
                self._rows[each][:] = rows[-1]

    def _find_time(self) -> float:
        return max(float(self._rows[self._leading][TIME]), self._time) - self._began

    def _describe(self, individual: str, arm: FedArm) -> LiveArm:
        row, spans = self._rows[individual], arm.process.row.spans

        def read(first: str, last: str = "") -> ReadBytes:
            return row[spans[first].start : spans[last or first].stop].tobytes

        return LiveArm(
            individual=individual,
            joints=arm.process.joints,
            measured=read("q", "dq"),
            wrench=read("wrench") if arm.feels_force else None,
            reference=read("reference"),
            base=arm.base,
            stamp=read("stamp_s"),
            velocity=read("velocity"),
            force=read("force"),
            timing=read("lost", "late_s"),
            control=self._watches[individual].report,
        )
