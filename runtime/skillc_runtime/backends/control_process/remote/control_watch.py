"""Watches a control process for displays: the state of its device, and how regular its periods are."""

from __future__ import annotations

from time import monotonic

import numpy as np

from skillc_runtime.backends.control_process.link import DeviceCondition
from skillc_runtime.backends.control_process.memory_plan import TIME
from skillc_runtime.backends.control_process.remote.host import ControlProcess
from skillc_runtime.devices.backend import BackendBroken
from skillc_runtime.devices.control_report import WINDOW_S, ControlReport, ControlState
from skillc_runtime.motion.pose import Array

ASK_S = 0.5
"""How often a device that is not under control is asked for its condition, in s."""


class ControlWatch:
    """Reports on one arm; `take` is given its cycles."""

    def __init__(self, process: ControlProcess) -> None:
        self._process = process
        self._cycles = np.empty((0, 2))
        self._state: tuple[ControlState, str] = ("ready", "")
        self._asked = -np.inf

    def take(self, rows: Array) -> None:
        """Take the rows of new cycles; those of the last seconds are kept."""
        late = self._process.row.spans["late_s"].start
        cycles = np.concatenate([self._cycles, rows[:, [TIME, late]]])
        self._cycles = cycles[cycles[:, 0] > monotonic() - WINDOW_S]

    def report(self) -> ControlReport:
        """Return how the arm is now."""
        process, snapshot = self._process, self._process.read()
        connected = process.connected
        state, sentence = self._find_state()
        rate_hz, late_s = (None, None) if state == "lost" else self._describe_cycles(connected.period_s)
        share = snapshot.number("speed_share")
        return ControlReport(
            name=process.name,
            state=state,
            sentence=sentence,
            period_s=connected.period_s,
            rate_hz=rate_hz,
            late_s=late_s,
            lost_periods=int(snapshot.number("lost")),
            speed_share=1.0 if np.isnan(share) else share,
            real_time=connected.real_time,
        )

    def _find_state(self) -> tuple[ControlState, str]:
        """Return the state with its sentence; one that has to be asked for may be half a second old."""
        if self._process.read().phase != "connected" or monotonic() > self._asked + ASK_S:
            self._state, self._asked = find_control_state(self._process), monotonic()
        return self._state

    def _describe_cycles(self, period_s: float) -> tuple[float | None, float | None]:
        """Return the rate in Hz and by how much the latest cycle began late in s; None for either without cycles."""
        if not len(self._cycles):
            return None, None
        late = self._cycles[:, 1]
        return float(1.0 / (period_s + late.mean())), max(0.0, float(late.max()))


def find_control_state(process: ControlProcess) -> tuple[ControlState, str]:
    """Return the state of an arm's device with its sentence; one under control is not asked, as that takes its time."""
    if (silence := process.find_silence()) is not None:
        return "lost", silence
    phase = process.read().phase
    if phase == "in-control":
        return "in-control", ""
    try:
        if phase == "lost":
            stop = process.call("device", "explain")
            return "lost", "" if stop is None else stop.reason
        condition: DeviceCondition = process.call("device", "condition")
    except BackendBroken as error:
        return "lost", str(error)
    return condition.kind, condition.sentence
