"""The memory of one arm, and the functions of a control period that are bound to it."""

from __future__ import annotations

import numpy as np

from skillc_runtime.control.arm_task import ArmTask
from skillc_runtime.control.command_validator import CommandValidator
from skillc_runtime.control.forward_dynamics import ForwardDynamics
from skillc_runtime.control.impedance import Impedance
from skillc_runtime.control.period import (
    IS_WATCHED,
    ArmMemory,
    ForwardDynamicsPeriod,
    ImpedancePeriod,
    PushPeriod,
    advance_all_pushes,
    begin_period,
    control_by_forward_dynamics,
    control_by_impedance,
    copy_state,
    make_state,
    watch_arm,
)
from skillc_runtime.devices.arm import Arm, ArmState, Command, Torque, command_values, copy_command
from skillc_runtime.motion.numerics.compiled import COMPILES, Bound, bind
from skillc_runtime.motion.pose import Array

Control = Bound[[float], int]
"""Computes the command of a period; returns bits of `period`."""


class ControlPeriod:
    """Runs what of the control periods of one arm is computed on memory.

    `memory` is all of it, for a law that is; it is replaced when the tool follows another path.
    """

    def __init__(self, arm: Arm, task: ArmTask, validator: CommandValidator, pushes: Array) -> None:
        """Bind them; pushes (n, m): a row for each push of the arm."""
        self._arm, self._task, self._pushes = arm, task, pushes
        state = task.measured.state
        # An arm need not be derived from `Arm`.
        self._lasts = getattr(arm, "lasting_state", None) is not None
        self._memory = ArmMemory(
            state if self._lasts else make_state(state.q.size),
            validator.holds,
            float(arm.interface == "torque"),
            task.place,
            validator.safety.memory,
            task.clock,
            task.period,
        )
        self.begin = bind(begin_period, self._memory)
        self._watch, self._contact = bind(watch_arm, self._memory), np.zeros(3)
        self._advance = bind(advance_all_pushes, PushPeriod(self._memory, pushes, self._contact))
        self._tau = np.zeros_like(state.q)
        self._live: Command = Torque(self._tau)
        self._control: Control | None = None
        self.memory: ImpedancePeriod | ForwardDynamicsPeriod | None = None
        self._bind()

    @property
    def is_computed(self) -> bool:
        """Whether `command` is that of this period: the tool is controlled, by a law that is computed on memory."""
        return self._control is not None and self._task.joints is None

    @property
    def functions(self) -> tuple[Control, Control] | None:
        """What a period calls, before and after the state is measured, if nothing happens; None if Python does more."""
        generator = self._task.tool.reference_generator
        if not self.is_computed or not self._lasts or generator.is_given:
            return None
        if generator.plan is not self._plan:
            self._bind()
        return None if self._control is None else (self.begin, self._control)

    @property
    def values(self) -> Array:
        """The command (nv,) that `functions` compute; the array changes, and stays."""
        return command_values(self._live)

    @property
    def command(self) -> Command:
        """The command of this period; the arrays of arms that keep their states change."""
        return self._live if self._lasts else copy_command(self._live)

    def measure(self) -> ArmState:
        """Return the present state of the arm."""
        state = self._arm.state()
        if not self._lasts:
            copy_state(state, self._memory.state)
        return state

    def watch(self) -> int:
        """Check the measured state; return bits of `period`."""
        return self._watch(0.0)

    def control(self, is_watched: bool = False) -> int:
        """Compute `command`, unless something is found before; return bits of `period`."""
        task, generator = self._task, self._task.tool.reference_generator
        if generator.plan is not self._plan:
            self._bind()
        generator.prepare(task.now)
        assert self._control is not None
        task.clock[IS_WATCHED] = is_watched
        events = self._control(0.0)
        task.clock[IS_WATCHED] = 0.0
        return events

    def advance_pushes(self) -> int:
        """Advance pushes after a command of any law; return bits of `period`."""
        self._contact[:] = self._task.contact_wrench()[:3]
        return self._advance(0.0)

    def give_up(self, state: ArmState) -> None:
        """Raise ControlError, for joints that do not follow."""
        law = self._task.controllers.tool
        assert isinstance(law, ForwardDynamics)
        law.limit.give_up(state)

    def _bind(self) -> None:
        """Bind the law, if it is one of those; without numba MuJoCo computes a virtual arm faster than Python does."""
        self._plan, arm, pushes = self._task.tool.reference_generator.plan, self._memory, self._pushes
        compliance = self._task.tool.compliance.memory
        match self._task.controllers.tool:
            case Impedance(memory=memory):
                self.memory = ImpedancePeriod(arm, compliance, self._plan, memory, pushes, self._tau)
                self._control = bind(control_by_impedance, self.memory)
            case ForwardDynamics(memory=memory, arm=virtual, limit=limit) if COMPILES:
                parts = arm, compliance, self._plan, memory, virtual.chain, virtual.state, pushes
                self.memory, self._live = ForwardDynamicsPeriod(*parts), limit.live
                self._control = bind(control_by_forward_dynamics, self.memory)
            case _:
                self._control = None
