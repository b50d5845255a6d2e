"""Writes what a control process publishes to the memory that it shares with the process of the tree."""

from __future__ import annotations

import numpy as np

from skillc_runtime.backends.control_process.link import StateView
from skillc_runtime.backends.control_process.memory_plan import MemoryPlan
from skillc_runtime.backends.control_process.periods.controlled_arm import ControlledArm
from skillc_runtime.backends.control_process.periods.pacing import CycleClock
from skillc_runtime.backends.control_process.shared_memory import SharedRecord, SharedRing
from skillc_runtime.backends.control_process.snapshot import PHASES, Phase
from skillc_runtime.motion.arrays import OutVector

SLOW_S = 0.01
"""What only skills read is computed this often, and after each call."""


class StatePublisher:
    """Publishes one arm, once a cycle and after each call; `memory` is of a `MemoryPlan`."""

    def __init__(
        self, plan: MemoryPlan, memory: OutVector, arm: ControlledArm, measured: StateView, clock: CycleClock
    ) -> None:
        self._arm, self._measured, self._clock = arm, measured, clock
        self._record = SharedRecord(plan.record(memory))
        self._ring = SharedRing(plan.ring(memory), plan.row.size)
        self._values, self._row = np.zeros(plan.layout.size), np.full(plan.row.size, np.nan)
        self._at = {name: self._values[span] for name, span in plan.layout.spans.items()}
        self._in_row = {name: self._row[span] for name, span in plan.row.spans.items()}
        self._slow_due = 0.0

    def publish(self, phase: Phase, seen_s: float) -> None:
        """Publish a cycle that began at `seen_s` of the machine's clock."""
        self._write_state(phase, seen_s)
        if seen_s >= self._slow_due:
            self._write_slow()
            self._slow_due = seen_s + SLOW_S
        self._record.write(self._values)
        self._write_row(seen_s)

    def publish_at_once(self, phase: Phase, seen_s: float, busy_until_s: float = 0.0) -> None:
        """Publish what a call has changed, or that it keeps the loop busy until then, in s of the machine's clock."""
        self._write_state(phase, seen_s)
        self._at["busy_until_s"][0] = busy_until_s
        self._write_slow()
        self._record.write(self._values)

    def _write_state(self, phase: Phase, seen_s: float) -> None:
        at, arm, clock = self._at, self._arm, self._clock
        state = arm.driver.measured.state
        at["time_s"][0], at["stamp_s"][0], at["phase"][0] = seen_s, self._measured.stamp_s[0], PHASES.index(phase)
        at["stopped"][0], at["faulted"][0] = arm.stop is not None, arm.driver.fault is not None
        at["lost"][0], at["late_s"][0] = clock.lost, clock.late_s
        at["speed_share"][:] = self._measured.speed_share
        at["q"][:], at["dq"][:], at["bias"][:], at["effort"][:] = state.q, state.dq, state.bias, state.effort
        at["position"][:], at["rotation"][:] = state.tool.position, state.tool.rotation.ravel()
        at["jacobian"][:], at["mass"][:] = state.jacobian.ravel(), state.mass_matrix.ravel()
        at["wrench"][:] = state.wrench

    def _write_slow(self) -> None:
        at, driver = self._at, self._arm.driver
        felt = driver.measured.felt
        at["felt"][:] = np.nan if felt is None else felt
        at["contact"][:] = driver.measured.contact_wrench
        at["reference"][:] = driver.motion.reference.rows.ravel()
        at["path_velocity"][:] = driver.motion.path_velocity
        at["done"][0], at["stationary"][0] = driver.motion.done, driver.motion.stationary
        at["at_rest"][0], at["released"][0] = driver.at_rest, driver.compliance.released
        at["stiffness"][:] = driver.compliance.commanded_stiffness
        at["force"][:] = driver.compliance.commanded_force
        number, push = self._arm.last_push
        pressed_s = None if push is None else push.pressed_s
        at["push"][0], at["pressed_s"][0] = number, np.nan if pressed_s is None else pressed_s

    def _write_row(self, seen_s: float) -> None:
        row, at, arm = self._in_row, self._at, self._arm
        row["time_s"][0], row["stamp_s"][0] = seen_s, at["stamp_s"][0]
        row["lost"][0], row["late_s"][0] = self._clock.lost, self._clock.late_s
        row["q"][:], row["dq"][:], row["wrench"][:] = at["q"], at["dq"], at["wrench"]
        row["velocity"][:], row["force"][:] = arm.arm.live_velocity, arm.driver.compliance.live_force
        row["reference"][:] = np.frombuffer(arm.driver.motion.copy_tool_reference())
        self._ring.write(self._row)
