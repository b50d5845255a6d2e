"""A simulated arm: motors and physics move it, and a wrist sensor feels forces."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf

from skillc_runtime.backends.mujoco.physics import Physics
from skillc_runtime.backends.mujoco.wrist import Wrist
from skillc_runtime.backends.simulation.arms.arm import ModelledArm, Payload
from skillc_runtime.backends.simulation.arms.brakes import Brakes
from skillc_runtime.backends.simulation.arms.command_link import find_greatest_delay, make_command_link
from skillc_runtime.backends.simulation.arms.joint_friction import make_joint_friction
from skillc_runtime.backends.simulation.arms.whole_mass import WholeMass
from skillc_runtime.backends.simulation.noise import make_joint_noise, make_wrist_noise
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.devices.arm import NotOffered
from skillc_runtime.devices.reality import NO_SIZES, Sizes
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.state.data_sheet import number_of
from skillc_runtime.world.state.terms import BRAKE_DELAY


class SimulatedArm(ModelledArm):
    """One arm of a simulated cell; it is called between `mj_step1` and `mj_step2`."""

    never_repeats = True

    def __init__(
        self,
        facts: ArmSpec,
        names: Mapping[str, str],
        physics: Physics,
        start: Array,
        seed: int,
        steps_per_command: int = 1,
        sizes: Sizes = NO_SIZES,
    ) -> None:
        """Place the joints at `start` (nv,) in rad; the noise of the sensors follows from the seed.

        `sizes` are the arm's imperfections.
        """
        noise, model, data, self._physics = make_joint_noise(facts, seed), physics.model, physics.data, physics
        self._wrist: Wrist | None = None
        super().__init__(facts, names, model, data, start, steps_per_command, noise, sizes)
        delay_s = number_of(facts.sheet.state, facts.sheet.individual, BRAKE_DELAY, inf)
        joints, step_s = self.motors.joints, model.opt.timestep
        self.motors.link = make_command_link(facts, sizes, seed, step_s * steps_per_command)
        self.command_delay_s = find_greatest_delay(facts)
        self.measures_link_torques = facts.sheet.has("jointTorqueTime")
        self.brakes = None if facts.has_servos or delay_s == inf else Brakes(joints, delay_s, step_s)
        self.friction = make_joint_friction(facts, sizes, self.motors, step_s)
        if self._feels_force and (gripper := self._gripper_name) is not None:
            time_s = facts.sheet.number("forceTorqueTime")
            noise = make_wrist_noise(facts, seed, sizes, model.opt.timestep)
            self._wrist = Wrist(model, data, gripper, time_s, self._gain, self._readings, noise, sizes)
            self.set_load(None)

    @property
    def braked(self) -> bool:
        """Whether the arm stands still whatever is commanded, or will once its brakes act."""
        return self._braked or (self.brakes is not None and not self.brakes.is_off)

    @property
    def takes_commands(self) -> bool:
        """Whether commands move the arm: until it holds still by itself, or its brakes act."""
        return not self._braked and (self.brakes is None or not self.brakes.act(self._data.time))

    def set_brakes(self, on: bool) -> None:
        """Hold the joints still from now on, or let commands take effect again."""
        super().set_brakes(on)
        if self.brakes is not None:
            if on:
                self.brakes.engage(self._data.time)
            else:
                self.brakes.release()

    def drop_brakes(self) -> None:
        """Let the brakes act as soon as they can; NotOffered by an arm with servos, or whose brakes are not known."""
        if self.brakes is None:
            raise NotOffered("nothing is known of the brakes of the arm")
        self.brakes.engage(self._data.time)

    @property
    def wrist(self) -> Wrist | None:
        """The force-torque sensor, which takes part in each step; None without one."""
        return self._wrist

    @property
    def _mean_readings(self) -> Array:
        return super()._mean_readings if self._wrist is None else self._wrist.mean

    def _whole_mass(self) -> WholeMass:
        return self._physics.mass

    def _configure(self, payload: Payload, tool: Pose) -> None:
        super()._configure(payload, tool)
        if self._wrist is not None:
            to_sensor = self._flange.inverse()
            self._wrist.configure(to_sensor @ tool, payload.mass_kg, to_sensor.apply(payload.centre))
