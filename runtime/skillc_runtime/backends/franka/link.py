"""The link to one arm through the Franka Control Interface: torques at 1 kHz, clocked by the robot."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from math import inf, pi
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np

from skillc_runtime.backends.control_process.link import (
    CommandView,
    ControlRefused,
    DeviceCondition,
    LinkAbilities,
    LinkLost,
    LinkMode,
    PointMass,
    RobotLink,
    StateView,
)
from skillc_runtime.backends.franka.arm_model import FLANGE_TURN, ArmModel, find_other_hand
from skillc_runtime.backends.franka.library import load_library
from skillc_runtime.backends.franka.robot_condition import IN_CONTROL, read_condition
from skillc_runtime.devices.backend import BackendUnavailable, StopPersists

PERIOD_S, JOINTS = 0.001, 7

SILENCE_S = 1.0
"""How long the library waits for a state before it gives up."""

RECOVERY_S = 1.5
"""How long a robot that recovers is waited for, in s."""

TORQUE_STEP_N_M = 0.98
"""The robot stops if a torque, without weight, changes by 1 N m from one command to the next, or from 0 at first."""

LOAD_DENSITY = 1000.0
"""A held mass counts as a ball of this density in kg/m^3: the robot refuses a mass without inertia."""


@dataclass(frozen=True, slots=True)
class FrankaDescription:
    """Where a robot is, what it must be, and from where on it counts a force as a collision, by facts of the arm.

    gravity: m/s^2 in the base. reflex_torques (nv,) in N m at the joints, reflex_forces (6,) in N and N m on the tool;
    None leaves what the robot has. rest_torque_n_m: which torque on a joint at rest is too much.
    """

    address: str
    model: Path
    gravity: tuple[float, ...] = (0.0, 0.0, -9.81)
    reflex_torques: tuple[float, ...] | None = None
    reflex_forces: tuple[float, ...] | None = None
    rest_torque_n_m: float = inf

    @property
    def name(self) -> str:
        """The device and its address."""
        return f"the robot at {self.address}"

    def make_link(self) -> FrankaLink:
        """Return a link that is not connected; BackendUnavailable without pylibfranka."""
        return FrankaLink(self, load_library())


class FrankaLink(RobotLink):
    """The connection to one robot, as pylibfranka offers it."""

    def __init__(self, description: FrankaDescription, library: Any) -> None:
        self._description, self._library = description, library
        self._torques = library.Torques
        self._model = ArmModel(description.model, np.array(description.gravity))
        self._carried: tuple[PointMass, PointMass] | None = None
        self._weighed = False
        self._robot: Any = None
        self._control: Any = None
        self._sent = np.zeros(0)
        self._condition = DeviceCondition("wrong-mode", f"{description.name} is not connected")

    @property
    def period_s(self) -> float:
        """The time between two states."""
        return PERIOD_S

    @property
    def abilities(self) -> LinkAbilities:
        """What the robot can do; its estimate of the wrench is not used, as that of the observer of efforts is."""
        return LinkAbilities(modes=("torque",), measures_effort=True, carries_weight=True, silence_s=SILENCE_S)

    def connect(self) -> None:
        """Connect, or connect again, without taking control; BackendUnavailable, with what to do."""
        self.close()
        name, library = self._description.name, self._library
        try:
            # A kernel without real-time scheduling is no reason to refuse: the control process takes what it may.
            self._robot = library.Robot(self._description.address, library.RealtimeConfig.kIgnore)
            self._set_collision_behaviour()
            self._condition = read_condition(self._robot.read_once(), controls=False)
        except (RuntimeError, library.FrankaException) as error:
            self._robot = None
            raise BackendUnavailable(
                f"there is no connection to {name} ({_sentence(error)}): is the address right (skiros:DriverAddress), "
                "is the robot on, are its joints unlocked, is FCI activated in Desk, and is no other program connected?"
            ) from error

    def read(self, state: StateView) -> None:
        """Wait for the robot's next state; LinkLost if none has come for `SILENCE_S`."""
        measured = self._receive()
        state.stamp_s[0] = measured.time.to_sec()
        state.speed_share[0] = 1.0
        state.q[:] = state.target[:] = measured.q
        state.dq[:] = measured.dq
        state.effort[:] = measured.tau_J
        state.wrench[:] = 0.0

    def write(self, command: CommandView) -> None:
        """Send torques (nv,) in N m, without weight, in steps that the robot takes; a refusal changes `condition`."""
        np.clip(command.values, self._sent - TORQUE_STEP_N_M, self._sent + TORQUE_STEP_N_M, out=self._sent)
        with self._naming_silence():
            try:
                self._control.writeOnce(self._torques(self._sent.tolist()))
            except self._library.ControlException as error:
                self._lose_control(error)

    @property
    def condition(self) -> DeviceCondition:
        """The condition as of the last `read` or `write`."""
        return self._condition

    def take_control(self, mode: LinkMode) -> None:
        """Take control for torques: until the first command the robot carries its weight, and nothing pushes it."""
        if mode != "torque":
            raise ControlRefused(f"{self._description.name} takes torques, and no commands of the kind {mode!r}")
        if self._control is not None:
            return
        with self._naming_silence():
            state = self._robot.read_once()
            self._condition = read_condition(state, controls=False)
            if self._condition.kind != "ready":
                raise ControlRefused(f"{self._description.name} does not give control: {self._condition.sentence}")
            self._compare(state)
        self._start()

    def give_back(self) -> None:
        """End the torque control with a last command; the robot's own controller holds the arm then."""
        if self._control is None:
            return
        control, self._control = self._control, None
        last = self._torques([0.0] * JOINTS)
        last.motion_finished = True
        with self._naming_silence():
            with suppress(self._library.ControlException):  # It has ended by itself; the state says why.
                control.readOnce()
                control.writeOnce(last)
            self._ask()

    def recover(self) -> None:
        """Let the robot recover from what has stopped it; StopPersists, with what somebody has to do."""
        if self._control is not None:
            return
        with self._naming_silence():
            if self._ask().kind == "ready":
                return
            try:
                self._robot.automatic_error_recovery()
            except self._library.CommandException as error:
                raise StopPersists(f"{self._description.name} does not recover: {_sentence(error)}") from error
            until = monotonic() + RECOVERY_S
            while (condition := self._ask()).kind != "ready" and monotonic() < until:
                pass
        if condition.kind != "ready":
            raise StopPersists(f"{self._description.name} has not recovered: {condition.sentence}")

    def set_load(self, hand: PointMass, held: PointMass) -> None:
        """Tell the robot what the hand holds: the hand is a setting in Desk. No load may change in motion."""
        had_control, self._carried = self._control is not None, (hand, held)
        self.give_back()
        with self._naming_silence():
            try:
                self._robot.set_load(held.mass_kg, (FLANGE_TURN @ held.centre).tolist(), ball_inertia(held.mass_kg))
            except self._library.CommandException as error:
                raise ControlRefused(f"{self._description.name} does not take the load: {_sentence(error)}") from error
        if had_control:
            self._start()

    def tare(self) -> None:
        """Do nothing: no wrench is measured."""

    def close(self) -> None:
        """Give control back and disconnect; raises nothing."""
        with suppress(LinkLost):  # A robot that does not answer ends its motion by itself.
            self.give_back()
        self._control = self._robot = None
        self._condition = DeviceCondition("wrong-mode", f"{self._description.name} is not connected")

    def _receive(self) -> Any:
        """Return the next state; one that ends the control is followed by one that says why."""
        with self._naming_silence():
            if self._control is not None:
                try:
                    state, _ = self._control.readOnce()
                except self._library.ControlException as error:
                    self._lose_control(error)
                else:
                    self._condition = read_condition(state, controls=True)
                    return state
            state = self._robot.read_once()
            self._condition = read_condition(state, controls=False)
            return state

    def _ask(self) -> DeviceCondition:
        """Return the condition of the robot by its next state, without control."""
        self._condition = read_condition(self._robot.read_once(), controls=False)
        return self._condition

    def _start(self) -> None:
        """Start the torque control of a robot that waits for it; ControlRefused."""
        with self._naming_silence():
            try:
                self._control = self._robot.start_torque_control()
            except (self._library.CommandException, self._library.ControlException) as error:
                raise ControlRefused(f"{self._description.name} does not give control: {_sentence(error)}") from error
        self._sent, self._condition = np.zeros(JOINTS), IN_CONTROL

    def _compare(self, state: Any) -> None:
        """Raise ControlRefused if a robot at rest is not the one of the facts; what it carries is looked at once.

        Later it may rest against something, where it stopped.
        """
        carried, difference = self._carried, self._model.find_other_arm(state)
        if carried is not None:
            difference = difference or find_other_hand(state, carried[0].mass_kg)
        if carried is not None and not self._weighed:
            most_n_m = self._description.rest_torque_n_m
            difference = difference or self._model.find_other_weight(state, carried, most_n_m)
            self._weighed = difference is None
        if difference is not None:
            raise ControlRefused(f"{self._description.name} is not as the facts say: {difference}")

    def _lose_control(self, error: Exception) -> None:
        self._control = None
        self._condition = DeviceCondition(
            "protective-stop", f"{self._description.name} ended the motion: {_sentence(error)}"
        )

    def _set_collision_behaviour(self) -> None:
        """Set from where on the robot stops by a reflex, and reports contact, if the facts say so."""
        torques, forces = self._description.reflex_torques, self._description.reflex_forces
        if torques is not None and forces is not None:
            self._robot.set_collision_behavior(list(torques), list(torques), list(forces), list(forces))

    @contextmanager
    def _naming_silence(self) -> Iterator[None]:
        """Turn an error of the network into LinkLost."""
        if self._robot is None:
            raise LinkLost(f"{self._description.name} is not connected")
        try:
            yield
        except self._library.NetworkException as error:
            self._control = None
            raise LinkLost(f"{self._description.name} does not answer any more ({_sentence(error)})") from error


def ball_inertia(mass_kg: float) -> list[float]:
    """Return the inertia (9,) in kg m^2, by columns, of a ball of `LOAD_DENSITY`: 2/5 m r^2."""
    radius = (0.75 * mass_kg / (pi * LOAD_DENSITY)) ** (1 / 3)
    return [float(each) for each in 0.4 * mass_kg * radius**2 * np.eye(3).ravel()]


def _sentence(error: Exception) -> str:
    """Return what a library says, without its name and its full stop."""
    return str(error).removeprefix("libfranka: ").removeprefix("libfranka robot: ").rstrip(".!")
