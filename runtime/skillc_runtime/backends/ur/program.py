"""The program of the client library on the controller, which obeys commands one by one."""

from __future__ import annotations

from typing import Any, Literal, TypeAlias, assert_never

import numpy as np

from skillc_runtime.backends.control_process.link import ControlRefused, LinkLost, PointMass
from skillc_runtime.backends.ur.facts import UrFacts
from skillc_runtime.backends.ur.leaving import do_within, in_one_line
from skillc_runtime.backends.ur.library import load_library
from skillc_runtime.backends.ur.states import UrStates
from skillc_runtime.motion.pose import Array

START_S, END_S, SETTLE_S = 1.2, 0.8, 0.2
"""How long the start and the end of the program, and what follows from new settings, may take."""

UrMode: TypeAlias = Literal["position", "velocity"]
"""The commands that the program obeys here."""

TARE_STATES = 100
"""Over so many states, 0.2 s of an e-Series arm, the wrench is averaged when it is to be 0."""


class UrProgram:
    """The connection that commands; the program runs once `start` has returned.

    has_ended: whether it was seen that the controller executes it no more; what runs then is somebody else's.
    """

    def __init__(self, facts: UrFacts, period_s: float, states: UrStates) -> None:
        """Connect; ControlRefused, with what to do."""
        self._facts, self._name, self._period_s, self._states = facts, facts.name, period_s, states
        self._contradiction: str | None = None
        self.has_ended = False
        interface = load_library("rtde_control").RTDEControlInterface
        try:
            self.connection: Any = interface(facts.address, 1.0 / period_s, interface.FLAG_NO_WAIT)
        except (RuntimeError, ValueError) as error:
            in_use = "already in use" in str(error)
            what = "another program commands it, or a fieldbus uses its registers" if in_use else in_one_line(error)
            raise ControlRefused(f"{self._name} does not give control: {what}") from error

    def start(self, load: PointMass) -> None:
        """Start the program with its watchdog, tool centre point and payload; ControlRefused, with what to do."""
        control = self.connection
        control.reuploadScript()
        started = self._states.await_that(lambda: self._states.executes and control.isProgramRunning(), START_S)
        if not started or not control.setWatchdog(1.0 / self._facts.command_timeout_s):
            raise ControlRefused(f"{self._name} does not start the program that obeys commands: look at its panel")
        # Moments are then about the flange, whichever of both points a version means.
        control.setTcp([0.0] * 6)
        self.set_load(load)
        if not self._states.await_that(lambda: self._states.explain_flange() is None, SETTLE_S):
            raise ControlRefused(self._states.explain_flange() or f"{self._name} moves")

    def find_contradiction(self) -> str | None:
        """Return how the arm has moved otherwise than its model, as of the last state; None if it has not so far."""
        if self._contradiction is None and not self._states.is_like_the_model:
            self._contradiction = self._states.explain_flange()
        return self._contradiction

    def send(self, mode: UrMode, values: list[float]) -> bool:
        """Send a command; tell whether it was taken. LinkLost if the connection has gone."""
        control, servo = self.connection, self._facts.servo
        if not (self._states.is_connected and control.isConnected()):
            raise LinkLost(f"{self._name} has closed the connection")
        match mode:
            case "position":
                return bool(control.servoJ(values, 0.0, 0.0, self._period_s, servo.lookahead_s, servo.gain))
            case "velocity":
                return bool(control.speedJ(values, servo.acceleration_rad_s2, 0.0))
            case _:
                assert_never(mode)

    def set_load(self, load: PointMass) -> None:
        """Set the payload of the controller, which subtracts its weight from the wrench."""
        # A centre of (0, 0, 0) would keep the one before.
        centre = load.centre if load.centre.any() else np.array([0.0, 0.0, 1e-6])
        self.connection.setPayload(float(load.mass_kg), centre.tolist())

    def explain_force(self) -> str | None:
        """Return why the present wrench cannot be the offset of the sensor; None if it can."""
        states = self._states
        if states.await_that(lambda: states.force_n <= self._facts.offset_n, SETTLE_S):
            return None
        return (
            f"the sensor of {self._name} feels {states.force_n:.0f} N before anything is done: something touches the "
            "tool, or the gripper does not weigh what its model says (ur:offsetForce is what counts as its offset)"
        )

    def tare(self) -> Array:
        """Let the present wrench be 0; return the mean wrench (6,) that remains: one noisy measurement was taken."""
        if not self.connection.zeroFtSensor():
            raise ControlRefused(f"{self._name} does not set its force-torque sensor to 0")
        row, total = np.zeros(6), np.zeros(6)
        for _ in range(TARE_STATES):
            self._states.await_next()
            self._states.read_wrench(row)
            total += row
            self.connection.kickWatchdog()
        return total / TARE_STATES

    def end(self, mode: UrMode | None) -> None:
        """Let the controller, which answers, brake and end the program."""
        do_within(END_S, lambda: self._end(mode))

    def _end(self, mode: UrMode | None) -> None:
        control, brake = self.connection, self._facts.servo.stop_rad_s2
        if not control.isProgramRunning():
            return
        if mode == "position":
            control.servoStop(brake)
        elif mode == "velocity":
            control.speedStop(brake)
        control.stopScript()
