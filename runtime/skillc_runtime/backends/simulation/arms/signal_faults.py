"""Faults of an arm's signals: what sensors or the line to the controller do to measurements; for benchmarks and tests.

The arm itself moves as before: its own servos, if it has some, measure for themselves. Where a joint is measured
wrongly, the tool centre point follows from what is measured, to first order.
"""

from __future__ import annotations

from math import inf
from typing import Final, Literal, TypeAlias, get_args

import msgspec
import numpy as np

from skillc_runtime.devices.arm import ArmState
from skillc_runtime.motion.pose import Array, exp

FaultKind: TypeAlias = Literal[
    "all-frozen", "all-intermittent", "position-frozen", "position-jumps", "speed-frozen", "speed-negated",
    "speed-out-of-range", "wrench-frozen", "wrench-zero", "wrench-negated", "wrench-jumps",
]  # fmt: skip
"""What can be wrong with the signals of an arm."""

KINDS: Final[tuple[FaultKind, ...]] = get_args(FaultKind)

JUMP_RAD, JUMP_N, FAST_RAD_S = 0.3, 300.0, 20.0
"""How far signals jump, and a speed that no joint has."""

DROPPED_S, BETWEEN_S = 0.06, 0.5
"""How long an intermittent signal stays as it is, and after which time it does so again, in s."""


class SignalFault(msgspec.Struct, frozen=True):
    """A fault of the signals of an arm from `starts_s` on, by the clock of the cell; `joint` where it is one joint's.

    stays_s: for how long the signals are wrong, again and again every `BETWEEN_S` if they are intermittent.
    """

    kind: FaultKind
    starts_s: float
    joint: int = 1
    stays_s: float = inf


class FaultySignals:
    """Falsifies the state of an arm, whose arrays these are, after it was measured.

    bias_is_measured: whether weights are computed from the joints measured here, and not by servos of the arm itself.
    velocity (3,): of the tool, m/s, in base, that is reported beside the state.
    """

    def __init__(self, fault: SignalFault, state: ArmState, velocity: Array, bias_is_measured: bool) -> None:
        self.fault, self._state, self._velocity = fault, state, velocity
        tool = state.tool
        self._arrays = [state.q, state.dq, tool.position, tool.rotation, state.jacobian, state.wrench, state.effort]
        self._arrays += [velocity] + ([state.bias, state.mass_matrix] if bias_is_measured else [])
        self._kept: list[Array] | None = None

    def falsify(self, now: float) -> None:
        """Let the fault change what was measured at `now` s."""
        fault = self.fault
        since = now - fault.starts_s
        if since < 0.0 or since > fault.stays_s:
            return
        if fault.kind == "all-intermittent" and since % BETWEEN_S > DROPPED_S:
            self._kept = None
            return
        if self._kept is None:
            self._kept = [each.copy() for each in self._arrays]
        if fault.kind.startswith("all"):
            for array, kept in zip(self._arrays, self._kept, strict=True):
                array[:] = kept
        elif fault.kind.startswith("wrench"):
            self._falsify_wrench(self._kept[5])
        else:
            self._falsify_joints(self._kept[0], self._kept[1])

    def _falsify_joints(self, q: Array, dq: Array) -> None:
        """Change joints (nv,) in rad and speeds in rad/s, which were q and dq when the fault began."""
        fault, state = self.fault, self._state
        match fault.kind:
            case "position-frozen":
                self._shift(q[fault.joint] - state.q[fault.joint])
            case "position-jumps":
                self._shift(JUMP_RAD)
            case "speed-frozen":
                self._set_speeds(dq)
            case "speed-negated":
                self._set_speeds(-state.dq)
            case "speed-out-of-range":
                self._set_speeds(np.where(np.arange(dq.size) == fault.joint, FAST_RAD_S, state.dq))

    def _falsify_wrench(self, before: Array) -> None:
        """Change the wrench (6,) in N and N m, which it was when the fault began."""
        wrench: Array = self._state.wrench
        match self.fault.kind:
            case "wrench-frozen":
                wrench[:] = before
            case "wrench-zero":
                wrench[:] = 0.0
            case "wrench-negated":
                wrench *= -1.0
            case "wrench-jumps":
                wrench[2] += JUMP_N

    def _shift(self, angle: float) -> None:
        """Let a joint be measured with an error in rad."""
        state, joint = self._state, self.fault.joint
        state.q[joint] += angle
        state.tool.position[:] += state.jacobian[:3, joint] * angle
        state.tool.rotation[:] = exp(state.jacobian[3:, joint] * angle) @ state.tool.rotation

    def _set_speeds(self, dq: Array) -> None:
        self._state.dq[:] = dq
        self._velocity[:] = self._state.jacobian[:3] @ dq
