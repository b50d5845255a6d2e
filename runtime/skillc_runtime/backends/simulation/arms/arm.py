"""An arm in the model of a cell: its measurements and its payload; a backend moves it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import msgspec
import mujoco
import numpy as np

from skillc_runtime.backends.simulation.arms.geometry_errors import make_geometry_errors
from skillc_runtime.backends.simulation.arms.motors import Joints, Motors, ServoGains, Servos, TorqueMotors
from skillc_runtime.backends.simulation.arms.parts import (
    find_actuator,
    find_live_body,
    find_mount,
    find_root,
    find_site,
    find_tool,
    read_limits,
)
from skillc_runtime.backends.simulation.arms.sensing import (
    BIAS,
    CARRYING,
    EFFORT,
    MASS_DUE,
    MEASURED_AT,
    SPEED,
    TARED_AT,
    ArmSensing,
    LastLink,
    MassMemory,
    Q,
    measure,
    take_mass,
    update_mass,
)
from skillc_runtime.backends.simulation.arms.signal_faults import FaultySignals, SignalFault
from skillc_runtime.backends.simulation.arms.whole_mass import WholeMass
from skillc_runtime.backends.simulation.machine_code import address_of
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.noise import Noise, make_no_noise
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.control.supervision.drift_watch import DriftWatch
from skillc_runtime.devices.arm import Arm, ArmLoad, ArmState, Capabilities, Command, Mode, NotOffered
from skillc_runtime.devices.reality import NO_SIZES, Sizes, make_tool_error
from skillc_runtime.motion.numerics.compiled import bind
from skillc_runtime.motion.numerics.program import IDLE, Rows, join, row_of
from skillc_runtime.motion.pose import Array, Pose


class Payload(msgspec.Struct, frozen=True):
    """The assumed payload of an arm without its gripper: mass kg, centre of mass (3,) m in the last link's frame."""

    mass_kg: float
    centre: Array


NO_PAYLOAD = Payload(0.0, np.zeros(3))


class ModelledArm(Arm):
    """One arm of a cell that is computed from a MuJoCo model, implementing `Arm`; subclasses move it.

    It reads positions, motion axes and bias forces in `data`, so it is called after they have been computed. There is
    one state, a read-only view of this object's buffers, updated by every call of `state`.
    """

    measures_effort: ClassVar[bool] = True
    """Whether `ArmState.effort` is what the motors exert."""

    never_repeats: ClassVar[bool] = False
    """Whether what is measured is never exactly the same twice while the arm moves."""

    command_delay_s: float = 0.0
    """The greatest delay of its commands, as far as it is known."""

    measures_link_torques: bool = False
    """Whether the effort is that on the links."""

    has_own_law: bool = False
    """Whether the robot itself has a compliant law, which takes targets of the tool."""

    def __init__(
        self,
        facts: ArmSpec,
        names: Mapping[str, str],
        model: Any,
        data: Any,
        start: Array,
        steps_per_command: int,
        noise: Noise | None = None,
        sizes: Sizes = NO_SIZES,
    ) -> None:
        """Place the joints at `start` (nv,) in rad; `noise` is that of the measured joint speeds.

        `names` are the short names of individuals, `sizes` the arm's imperfections.
        """
        name = names[facts.individual]
        self._gripper_name = gripper = None if facts.gripper is None else names[facts.gripper.individual]
        self._model, self._data = model, data
        joints = [j for j in range(model.njnt) if model.joint(j).name.startswith(part_name(name, ""))]
        first, count = int(model.jnt_dofadr[joints[0]]), len(joints)
        q_first = int(model.jnt_qposadr[joints[0]])
        actuator = find_actuator(joints[0], model)
        self._dofs = slice(first, first + count)
        self._q_span = slice(q_first, q_first + count)
        self._q, self._dq = data.qpos[self._q_span], data.qvel[self._dofs]
        self._bias = data.qfrc_bias[self._dofs]
        self._base = find_root(model, model.jnt_bodyid[joints[0]], part_name(name, ""))
        self._mount = find_mount(model, name, self._base)
        self._link = int(model.site_bodyid[model.site(part_name(name, "flange")).id])
        self.limits = read_limits(model, joints, actuator, facts)
        self.fixed_tool = find_tool(model, name, gripper)
        self._hand = LastLink()
        self._joints, self._velocity = np.zeros((7, count)), np.zeros(3)
        self._here = _blank(self._joints, self._hand.tool)
        self._state = _read_only(self._here)
        self._weight, self._carrying, self._payload_kg = np.zeros(3), self._joints[CARRYING], np.zeros(1)
        self._noise, self._times = noise or make_no_noise(count), np.zeros(3)
        self._flange = find_site(model.site(part_name(name, "flange")))
        self._feels_force = facts.force_torque and gripper is not None
        self._gain, self._readings = np.zeros((6, 9)), np.zeros(9)
        self._modelled, self._tool_error = _model_weight(facts, sizes), make_tool_error(sizes)
        self._correction = np.zeros(count)
        effort_bias = np.multiply(sizes.get("jointTorqueBias", 0.0), self.limits.effort)
        self._effort_bias = np.broadcast_to(effort_bias, count).copy()
        self._damping, self._zero, self._zero_at_tool = np.zeros(count), np.zeros(6), np.zeros((2, 6))
        self._drift = DriftWatch()
        self._believed_base = find_live_body(data, self._mount)
        self._geometry = make_geometry_errors(sizes, joints, model, data)
        self._sensing = self._make_sensing()
        self._measure, mass = bind(measure, self._sensing), self._make_mass()
        self._take_mass, self._update_mass = bind(take_mass, mass), bind(update_mass, mass)
        self._times[MEASURED_AT], self._braked = data.time, False
        self._faulty: FaultySignals | None = None
        self._configure(NO_PAYLOAD, self.fixed_tool)
        self._q[:] = start
        self._motors = self._make_motors(facts, slice(actuator, actuator + count), steps_per_command)

    @property
    def capabilities(self) -> Capabilities:
        """The capabilities of the arm."""
        return Capabilities(
            self._motors.modes, self._feels_force, self.measures_effort, self.limits, self.never_repeats,
            self.command_delay_s, self.measures_link_torques,
        )  # fmt: skip

    @property
    def interface(self) -> Mode:
        """The kind of commands that the arm takes."""
        return self._motors.mode

    def switch(self, mode: Mode) -> None:
        """Take commands of this kind, at rest until the first; ModeRefused if the arm does not offer it."""
        self._motors.switch(mode)

    @property
    def base(self) -> Pose:
        """The pose of the arm's base in the world."""
        live = self.live_base
        return Pose(live.position.copy(), live.rotation.copy())

    @property
    def live_base(self) -> Pose:
        """The pose of the arm's base in the world, as far as that is known; its arrays change."""
        return self._believed_base

    @property
    def live_joints(self) -> Array:
        """The angles (nv,) in rad and speeds (nv,) in rad/s as they were measured last, one a row; not a copy."""
        return self._joints[: SPEED + 1]

    @property
    def live_wrench(self) -> Array | None:
        """The wrench (6,) of a force-torque sensor, in base; not a copy. None without one."""
        return self._here.wrench if self._feels_force else None

    @property
    def live_velocity(self) -> Array:
        """The velocity (3,) in m/s of the tool, in base, as it was measured last; not a copy."""
        return self._velocity

    @property
    def lasting_state(self) -> ArmState | None:
        """The state, which is always the same object."""
        return self._state

    def state(self) -> ArmState:
        """Return the present state, in the arm's base frame."""
        now = self._data.time
        if self._measure(now):
            self._noise.draw()
            self._measure(now)
        if now >= self._times[MASS_DUE]:
            self._update_mass_matrix()
        if self._faulty is not None:
            self._faulty.falsify(now)
        return self._state

    @property
    def is_faulty(self) -> bool:
        """Whether a fault changes what is measured, now or later."""
        return self._faulty is not None

    def set_fault(self, fault: SignalFault | None) -> None:
        """Let a fault change what is measured; None ends it."""
        made = isinstance(self._motors, TorqueMotors)
        self._faulty = None if fault is None else FaultySignals(fault, self._here, self._velocity, made)

    @property
    def measuring(self) -> Rows | None:
        """The functions that update the state; None if only Python can."""
        if self.is_faulty:
            return None
        return join(row_of(self._measure), row_of(self._update_mass) if address_of("mj_fullM") else None)

    def taking(self, values: Array) -> Rows | None:
        """Return the function that takes commands of the interface from there (nv,); None if only Python can."""
        if self.braked:
            return None if self.takes_commands else IDLE
        return self._motors.taking(values)

    def command(self, command: Command) -> None:
        """Take a command for the next step; TypeError for another kind than `interface`."""
        if self.takes_commands:
            self._motors.command(command)

    @property
    def motors(self) -> Motors:
        """What sets the actuators in each step: as commanded, or to hold the arm still if commands have stopped."""
        return self._motors

    def set_load(self, load: ArmLoad | None) -> None:
        """Count this as held from now on; None for the empty hand."""
        if load is None:
            self._carrying[:] = 0.0
            self._configure(NO_PAYLOAD, self.fixed_tool)
        else:
            payload = Payload(load.mass_kg, (self.fixed_tool @ load.held).apply(load.centre))
            self._configure(payload, self.fixed_tool @ load.tool)

    @property
    def measured_s(self) -> float:
        """When the last state was measured, in s: the clock of a simulated arm is that of its cell."""
        return float(self._times[MEASURED_AT])

    def flange_at(self, q: Array) -> Pose:
        """Return the flange in base for joints q (nv,) in rad."""
        data = mujoco.MjData(self._model)
        data.qpos[:] = self._data.qpos
        data.qpos[self._q_span] = q
        mujoco.mj_kinematics(self._model, data)
        link, base = (find_live_body(data, body) for body in (self._link, self._base))
        return base.inverse() @ link @ self._flange

    @property
    def mean_wrench(self) -> Array | None:
        """The mean wrench (6,) of the last second or so, along the axes of the sensor; None without one."""
        if not self._feels_force:
            return None
        zero, drift = self._zero_at_tool
        mean: Array = self._gain @ self._mean_readings - zero - drift * self._tared_s
        return mean

    def tare(self) -> None:
        """Let the wrench of the force-torque sensor be 0 from now on; NotOffered without one."""
        wrench = self.mean_wrench
        if wrench is None:
            raise NotOffered("the arm has no force-torque sensor")
        self._zero[:3] += wrench[:3] + self._drift.rate * self._tared_s
        self._zero[3:] += wrench[3:] + np.cross(self._lever(), wrench[:3])
        down = -(self._here.tool.rotation.T @ self.base.rotation[2])
        self._drift.note(wrench[:3], down, self.measured_s)
        self._times[TARED_AT] = self.measured_s
        self._move_zero()

    @property
    def force_drift(self) -> Array:
        """How fast the force (3,) of the sensor was found to drift, in N/s along its axes; it is taken off."""
        return self._drift.rate.copy()

    def correct_bias(self, torque: Array) -> None:
        """Add a torque (nv,) in N m to the bias from now on."""
        self._correction += torque

    @property
    def braked(self) -> bool:
        """Whether the arm stands still whatever is commanded."""
        return self._braked

    @property
    def takes_commands(self) -> bool:
        """Whether commands move the arm."""
        return not self._braked

    def set_brakes(self, on: bool) -> None:
        """Hold the joints still from now on, or let commands take effect again."""
        self._braked = on

    @property
    def _mean_readings(self) -> Array:
        """The readings (9,) of the force-torque sensor by whose wrench it is tared: here those of the present."""
        return self._readings

    def _lever(self) -> Array:
        """Return the way (3,) in m from the flange to the tool centre point, along the axes of the flange."""
        at = self._flange.inverse() @ self._tool
        return at.position

    @property
    def _tared_s(self) -> float:
        """The time in s since the sensor was tared."""
        return float(self._times[MEASURED_AT] - self._times[TARED_AT])

    def _move_zero(self) -> None:
        """Compute the wrench of the sensor that counts as 0 and its drift, along its axes, at the tool centre point."""
        zero, drift, rate = self._zero_at_tool[0], self._zero_at_tool[1], self._drift.rate
        zero[:3], zero[3:] = self._zero[:3], self._zero[3:] - np.cross(self._lever(), self._zero[:3])
        drift[:3], drift[3:] = rate, -np.cross(self._lever(), rate)

    def _make_sensing(self) -> ArmSensing:
        data, hand, here = self._data, self._hand, self._here
        return ArmSensing(
            joints=self._joints,
            in_base=hand.in_base,
            rotation=hand.rotation,
            jacobian=here.jacobian,
            wrench=here.wrench,
            velocity=self._velocity,
            q=self._q,
            dq=self._dq,
            bias=self._bias,
            modelled=self._modelled,
            correction=self._correction,
            effort_bias=self._effort_bias,
            on_link=hand.on_link,
            motion_axes=data.cdof[self._dofs],
            centre=data.subtree_com[self._model.body_rootid[self._link]],
            link=find_live_body(data, self._link),
            base=find_live_body(data, self._base),
            weight=self._weight,
            actuators=data.qfrc_actuator[self._dofs],
            applied=data.qfrc_applied[self._dofs],
            passive=data.qfrc_passive[self._dofs],
            damping=self._damping,
            gain=self._gain,
            readings=self._readings,
            zero=self._zero_at_tool,
            noise=self._noise.rows,
            used=self._noise.used,
            times=self._times,
            geometry=self._geometry,
        )

    def _make_mass(self) -> MassMemory:
        self._whole = whole = self._whole_mass()
        first, lever, here = float(self._dofs.start), self._hand.lever, self._here
        return MassMemory(
            here.mass_matrix, whole.matrix, first, whole.calls, self._payload_kg, self._times, lever, here.jacobian
        )

    def _whole_mass(self) -> WholeMass:
        """Return what computes the mass matrix of the whole cell."""
        return WholeMass(self._model, self._data)

    def _make_motors(self, facts: ArmSpec, actuators: slice, steps_per_command: int) -> Motors:
        data, here, timestep = self._data, self._here, self._model.opt.timestep
        joints = Joints(
            data.ctrl[actuators], data.qfrc_applied[self._dofs], self._q, self._dq, self._bias,
            here.bias, self._carrying, here.mass_matrix, self.limits.effort,
        )  # fmt: skip
        if not facts.has_servos:
            return TorqueMotors(joints, timestep)
        model = self._model
        gains = ServoGains(model.actuator_gainprm[actuators, 0], -model.actuator_biasprm[actuators, 2])
        self._damping[:] = gains.damping / steps_per_command
        return Servos(joints, facts.modes, timestep, gains, steps_per_command)

    def _configure(self, payload: Payload, tool: Pose) -> None:
        self.payload, self._tool, self._times[MASS_DUE] = payload, tool, 0.0
        self._payload_kg[0] = payload.mass_kg
        self._hand.configure(tool @ self._tool_error, self._flange.rotation, payload.centre)
        self._drift.forget_posture()
        self._move_zero()
        np.multiply(self._model.opt.gravity, -payload.mass_kg, out=self._weight)

    def _update_mass_matrix(self) -> None:
        self._whole.compute()
        self._take_mass(self._data.time)


def _model_weight(facts: ArmSpec, sizes: Sizes) -> float:
    """Return by what an arm that commands torques multiplies its true weight to know it; servos know theirs."""
    (error,) = sizes.get("gravityError", (0.0,))
    return 1.0 if facts.has_servos else 1.0 + error


def _blank(joints: Array, tool: Pose) -> ArmState:
    """Return a state whose q, dq and bias are rows of `joints`."""
    count = joints.shape[1]
    jacobian, mass = np.zeros((6, count)), np.zeros((count, count))
    return ArmState(joints[Q], joints[SPEED], tool, jacobian, mass, joints[BIAS], np.zeros(6), joints[EFFORT])


def _read_only(state: ArmState) -> ArmState:
    """Return read-only views of the same arrays."""
    tool = Pose(*(_view(part) for part in (state.tool.position, state.tool.rotation)))
    q, dq, jacobian, mass, bias, wrench, effort = map(
        _view, (state.q, state.dq, state.jacobian, state.mass_matrix, state.bias, state.wrench, state.effort)
    )
    return ArmState(q, dq, tool, jacobian, mass, bias, wrench, effort)


def _view(array: Array) -> Array:
    view = array.view()
    view.flags.writeable = False
    return view
