"""The memory of one arm, and the functions of a control period that are bound to it."""

from __future__ import annotations

import numpy as np

from skillc_runtime.control.arm_task import ArmTask
from skillc_runtime.control.command_validator import CommandValidator
from skillc_runtime.control.impedance import Impedance
from skillc_runtime.control.period import (
    ArmMemory,
    ImpedancePeriod,
    PushPeriod,
    advance_all_pushes,
    control_by_impedance,
    copy_state,
    make_state,
    watch_arm,
)
from skillc_runtime.devices.arm import Arm, ArmState, Torque
from skillc_runtime.motion.numerics.compiled import bind
from skillc_runtime.motion.pose import Array


class ControlPeriod:
    """Runs what of the control periods of one arm is computed on memory."""

    def __init__(self, arm: Arm, task: ArmTask, validator: CommandValidator, pushes: Array) -> None:
        """Bind them; pushes (n, m): a row for each push of the arm."""
        self._arm, self._task, self._pushes = arm, task, pushes
        state = task.measured.state
        self._lasts = getattr(arm, "lasting_state", None) is not None  # An arm need not be derived from `Arm`.
        self._memory = ArmMemory(
            state if self._lasts else make_state(state.q.size),
            validator.holds,
            float(arm.interface == "torque"),
            task.place,
            validator.safety.memory,
        )
        self._watch, self._contact = bind(watch_arm, self._memory), np.zeros(3)
        self._advance = bind(advance_all_pushes, PushPeriod(self._memory, pushes, self._contact))
        self._tau = np.zeros_like(state.q)
        self._torque = Torque(self._tau)
        law = task.controllers.tool
        self._law = law if isinstance(law, Impedance) else None
        self._bind()

    @property
    def gives_torques(self) -> bool:
        """Whether `torque` is the command of this period: the law is computed on memory, and the tool is controlled."""
        return self._law is not None and self._task.joints is None

    @property
    def torque(self) -> Torque:
        """The command of this period; the arrays of arms that keep their states change."""
        return self._torque if self._lasts else Torque(self._tau.copy())

    def measure(self) -> ArmState:
        """Return the present state of the arm."""
        state = self._arm.state()
        if not self._lasts:
            copy_state(state, self._memory.state)
        return state

    def watch(self) -> int:
        """Check the measured state; return bits of `period`."""
        return self._watch(self._task.period)

    def control(self, is_watched: bool) -> int:
        """Compute `torque`, unless something is found before; return bits of `period`."""
        task, generator = self._task, self._task.tool.reference_generator
        if generator.plan is not self._plan:
            self._bind()
        generator.prepare(task.now)
        return self._control(task.now, task.period, is_watched)

    def advance_pushes(self) -> int:
        """Advance pushes after a command of any law; return bits of `period`."""
        self._contact[:] = self._task.contact_wrench()[:3]
        return self._advance(self._task.period)

    def _bind(self) -> None:
        self._plan = self._task.tool.reference_generator.plan
        if self._law is not None:
            parts = self._task.tool.compliance.memory, self._plan, self._law.memory, self._pushes, self._tau
            self._control = bind(control_by_impedance, ImpedancePeriod(self._memory, *parts))
