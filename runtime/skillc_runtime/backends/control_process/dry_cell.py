"""The cell of a dry run: a simulation that begins where the devices were measured, and keeps what would be sent."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from msgspec.structs import replace

from skillc_runtime.backends.control_process.fingers import find_fingers
from skillc_runtime.backends.control_process.periods.command_limits import CommandLimits
from skillc_runtime.backends.control_process.periods.facts import read_rate_limits
from skillc_runtime.backends.mujoco.arm import SimulatedArm
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.mujoco.gripper import SimulatedGripper
from skillc_runtime.backends.simulation.arms.start_postures import find_overlap
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.devices.arm import ArmState, Command, Mode, command_values
from skillc_runtime.devices.command_record import RecordedCommands
from skillc_runtime.devices.observed import ObservedArm, ObservedCell
from skillc_runtime.motion.numerics.program import Rows
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel

ALTERED = 1e-6
"""A command that differs by more, in N m, rad or rad/s, from what the law wants was altered by the limits."""

STEP_S = 0.001


class DryCell(SimulatedCell):
    """A simulated cell whose arms have the rates of their devices; implements `CommandRecord`."""

    def __init__(self, world: WorldModel, seed: int, seen: ObservedCell) -> None:
        """Begin where the devices were seen.

        SheetError or FrameError if facts are missing, or if an arm that stands there touches something by the scene.
        """
        self._seen = {each.arm: each for each in seen.arms}
        self._openings = {each.gripper: each.opening_m for each in seen.grippers}
        period_s = min(each.period_s for each in seen.arms)
        self._kept: dict[str, DryArm] = {}
        super().__init__(world, seed, STEP_S, max(1, round(period_s / STEP_S)))
        self.capabilities = replace(self.capabilities, checkpoints=None, commands=self)

    def commands(self) -> tuple[RecordedCommands, ...]:
        """Return the commands of all arms."""
        return tuple(arm.keeper.collect(arm, name) for name, arm in sorted(self._kept.items()))

    def _start(self, arm: ArmSpec) -> Array:
        seen = self._seen[self.scene.names[arm.individual]]
        q = np.array([each.measured_rad for each in seen.joints])
        if (overlap := find_overlap(arm, q)) is not None:
            raise SheetError(
                f"{seen.arm} is measured where the scene has something else, with {overlap}: correct the scene, or "
                "move the arm"
            )
        return q

    def _make_arms(self) -> tuple[dict[str, SimulatedArm], dict[str, SimulatedGripper]]:
        names, things = self.scene.names, self.scene.graspable
        arms: dict[str, SimulatedArm] = {}
        hands: dict[str, SimulatedGripper] = {}
        for facts in self.scene.arms:
            arms[facts.individual] = arm = self._make_arm(facts, self._seen[names[facts.individual]])
            if (gripper := facts.gripper) is not None:
                hand = SimulatedGripper(gripper, names, things, arm, self.physics, self.variation.seed)
                hands[facts.individual] = hand
                self._place_fingers(names[gripper.individual], hand)
        return arms, hands

    def _make_arm(self, facts: ArmSpec, seen: ObservedArm) -> DryArm:
        names, steps = self.scene.names, self._steps_per_command
        arm = DryArm(facts, names, self.physics, self._start(facts), self.variation.seed, steps)
        arm.keeper = CommandKeeper(facts, tuple(each.joint for each in seen.joints), self.period_s)
        self._kept[names[facts.individual]] = arm
        return arm

    def _place_fingers(self, name: str, hand: SimulatedGripper) -> None:
        """Let a gripper be as open as it was seen."""
        if name in self._openings:
            opening = min(max(self._openings[name], 0.0), hand.max_opening_m)
            fingers, shares = find_fingers(self.model, name)
            self.data.qpos[fingers] = opening / shares.sum()
            hand.move(opening, hand.max_force_n)


@dataclass(eq=False, slots=True)
class CommandKeeper:
    """Limits and keeps the commands of one arm, whose cycles are a period in s apart; `altered` counts those that the
    limits have changed."""

    facts: ArmSpec
    joints: tuple[str, ...]
    period_s: float
    altered: int = 0
    times_s: list[float] = field(default_factory=list)
    values: list[Array] = field(default_factory=list)
    _limits: CommandLimits | None = None

    def limit(self, command: Command, arm: SimulatedArm, measured: ArmState, now_s: float) -> Command:
        """Return a command within the limits, and keep it; ControlError if it is far beyond them."""
        wanted = command_values(command)
        if self._limits is None:
            self._limits = CommandLimits(arm.limits, read_rate_limits(self.facts), self.period_s)
            self._limits.begin(arm.interface, measured.q, measured.bias)
        limited = np.array(wanted)
        self._limits.apply(arm.interface, limited, measured.bias)
        self.altered += bool(np.abs(limited - wanted).max() > ALTERED)
        self.times_s.append(now_s)
        self.values.append(limited)
        return type(command)(limited)

    def collect(self, arm: SimulatedArm, name: str) -> RecordedCommands:
        """Return what was kept."""
        mode: Mode = arm.interface
        values = np.array(self.values).reshape(len(self.values), len(self.joints))
        return RecordedCommands(name, mode, self.joints, arm.limits, np.array(self.times_s), values, self.altered)


class DryArm(SimulatedArm):
    """An arm of a dry run; `keeper` limits and keeps its commands."""

    keeper: CommandKeeper

    def taking(self, values: Array) -> Rows | None:
        """Return None: each command is limited, and kept, in Python."""
        return None

    def command(self, command: Command) -> None:
        """Take a command as the device would get it."""
        super().command(self.keeper.limit(command, self, self._here, float(self._data.time)))
