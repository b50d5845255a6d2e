"""The memory of one arm, and the functions of a control period that are bound to it."""

from __future__ import annotations

import numpy as np

from skillc_runtime.control.arm_task import ArmTask
from skillc_runtime.control.laws.forward_dynamics import ForwardDynamics
from skillc_runtime.control.laws.impedance import Impedance
from skillc_runtime.control.limits import JointLimit, TorqueLimit
from skillc_runtime.control.period import (
    IS_WATCHED,
    ArmMemory,
    ForwardDynamicsPeriod,
    ImpedancePeriod,
    JointPeriod,
    PushPeriod,
    advance_all_pushes,
    begin_period,
    control_by_forward_dynamics,
    control_by_impedance,
    control_joints_by_servos,
    control_joints_by_torques,
    copy_state,
    make_state,
    watch_arm,
)
from skillc_runtime.control.supervision.command_validator import CommandValidator
from skillc_runtime.devices.arm import Arm, ArmState, Command, Torque, command_values, copy_command
from skillc_runtime.motion.joint_plan import JointPlan
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
        limit = task.controllers.limit
        self._live: Command = Torque(self._tau) if isinstance(limit, TorqueLimit) else limit.live
        self._control: Control | None = None
        self._joints: JointPlan | None = None
        self.memory: ImpedancePeriod | ForwardDynamicsPeriod | None = None
        self._bind()

    @property
    def is_computed(self) -> bool:
        """Whether `command` is that of this period: of joints, or of a tool whose law is computed on memory."""
        return self._task.joints is not None or self._control is not None

    @property
    def functions(self) -> tuple[Control, Control] | None:
        """What a period calls, before and after the state is measured, if nothing happens; None if Python does more."""
        if not self._lasts or (control := self._present) is None:
            return None
        is_given = self._task.joints is None and self._task.tool.reference_generator.is_given
        return None if is_given else (self.begin, control)

    @property
    def values(self) -> Array:
        """The command (nv,) that `functions` compute, in N m, rad or rad/s; the array changes, and stays."""
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
        task, control = self._task, self._present
        assert control is not None
        if task.joints is None:
            task.tool.reference_generator.prepare(task.now)
        task.clock[IS_WATCHED] = is_watched
        events = control(0.0)
        task.clock[IS_WATCHED] = 0.0
        return events

    @property
    def _present(self) -> Control | None:
        """What computes the command now, bound to what is followed now."""
        joints = self._task.joints
        if joints is None:
            if self._task.tool.reference_generator.plan is not self._plan:
                self._bind()
            return self._control
        if joints.plan is not self._joints:
            self._joints, self._control_joints = joints.plan, self._bind_joints(joints.plan)
        return self._control_joints

    def advance_pushes(self) -> int:
        """Advance pushes after a command of any law; return bits of `period`."""
        self._contact[:] = self._task.contact_wrench()[:3]
        return self._advance(0.0)

    def give_up(self, state: ArmState) -> None:
        """Raise ControlError, for joints that do not follow."""
        limit = self._task.controllers.limit
        assert isinstance(limit, JointLimit)
        limit.give_up(state)

    def _bind_joints(self, joints: JointPlan) -> Control:
        limit, compliance = self._task.controllers.limit, self._task.tool.compliance.memory
        rate = limit.rate if isinstance(limit, TorqueLimit) else 0.0
        memory = JointPeriod(self._memory, compliance, joints, limit.rows, rate, self._tau, self._pushes)
        law = control_joints_by_torques if isinstance(limit, TorqueLimit) else control_joints_by_servos
        return bind(law, memory)

    def _bind(self) -> None:
        """Bind the law, if it is one of those; without numba MuJoCo computes a virtual arm faster than Python does."""
        self._plan, arm, pushes = self._task.tool.reference_generator.plan, self._memory, self._pushes
        compliance = self._task.tool.compliance.memory
        match self._task.controllers.tool:
            case Impedance(memory=memory):
                self.memory = ImpedancePeriod(arm, compliance, self._plan, memory, pushes, self._tau)
                self._control = bind(control_by_impedance, self.memory)
            case ForwardDynamics(memory=memory, arm=virtual) if COMPILES:
                parts = arm, compliance, self._plan, memory, virtual.chain, virtual.state, pushes
                self.memory = ForwardDynamicsPeriod(*parts)
                self._control = bind(control_by_forward_dynamics, self.memory)
            case _:
                self._control = None
