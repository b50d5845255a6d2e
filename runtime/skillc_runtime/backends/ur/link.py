"""The link to one arm of Universal Robots: its controller clocks the loop at 500 Hz, or at 125 Hz before the e-Series.

The client library connects again by itself after 2.5 s of silence, in a thread of its own; then in two threads, again
and again, until it crashes. Therefore no command is sent to a controller that is silent or gone, and a new process
connects after a connection was lost. The program that obeys commands is uploaded by `take_control` alone.
"""

from __future__ import annotations

import re
from contextlib import suppress
from socket import create_connection, socket
from types import TracebackType

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
from skillc_runtime.backends.ur.facts import UrFacts
from skillc_runtime.backends.ur.leaving import CLOSE_S, Leaving
from skillc_runtime.backends.ur.program import UrMode, UrProgram
from skillc_runtime.backends.ur.states import UrStates
from skillc_runtime.devices.backend import BackendUnavailable, StopPersists

PORT, TIMEOUT_S = 29999, 1.0

RELEASE_S = 1.0
"""How long the release of a stop, and the end of a program, may take."""

LOOK_S = 0.2
"""So long it is watched, before control is taken, whether somebody else has just started a program: a controller says
that it executes one only once it has prepared it. Nobody has published how long that takes."""

E_SERIES = 5
"""The first version of PolyScope of the e-Series, which has a force-torque sensor and 500 Hz."""

NO_MASS = PointMass(0.0, np.zeros(3))


class UrLink(RobotLink):
    """The connection to one arm, as ur-rtde offers it."""

    def __init__(self, facts: UrFacts) -> None:
        self._facts, self._name = facts, facts.name
        self._states: UrStates | None = None
        self._program: UrProgram | None = None
        self._mode: UrMode | None = None
        self._leaving = Leaving()
        self._is_tared, self._offset = False, np.zeros(6)
        self._load, self._version = NO_MASS, (0, 0)
        self._condition = DeviceCondition("wrong-mode", f"{self._name} is not connected")

    @property
    def period_s(self) -> float:
        """The time between two states in s."""
        return 0.002 if self._version[0] >= E_SERIES else 0.008

    @property
    def abilities(self) -> LinkAbilities:
        """What the controller can do: it subtracts weight and offset from the wrench, and carries the arm."""
        return LinkAbilities(
            modes=("position", "velocity"),
            wrench="without-weight" if self._version[0] >= E_SERIES else "none",
            carries_weight=True,
            tares=self._version[0] >= E_SERIES,
            silence_s=self._facts.silence_s,
            reconnects=False,
        )

    def connect(self) -> None:
        """Connect to the dashboard server and to the exchange; BackendUnavailable, with what to do."""
        with Dashboard(self._name, self._facts.address) as dashboard:
            self._version = dashboard.version
        self._states = UrStates(self._facts, self.period_s)
        self._update_condition()

    def read(self, state: StateView) -> None:
        """Wait for the next state; LinkLost if none has come for `silence_s`."""
        states = self._connected
        states.await_next()
        states.read(state)
        np.subtract(state.wrench, self._offset, out=state.wrench)
        self._update_condition()

    def write(self, command: CommandView) -> None:
        """Send a command of the mode that was taken; the condition says whether it has effect."""
        if self._program is None or self._mode is None:
            return
        if not self._program.send(self._mode, command.values.tolist()):
            self._update_condition()

    @property
    def condition(self) -> DeviceCondition:
        """The condition as of the last `read` or `write`."""
        return self._condition

    def take_control(self, mode: LinkMode) -> None:
        """Upload the program that obeys commands, and wait until it runs; ControlRefused, with what to do."""
        if mode != "position" and mode != "velocity":
            raise ControlRefused(f"{self._name} takes positions and speeds of its joints, and no {mode} commands")
        self.give_back()
        self._connected.await_program(LOOK_S)
        self._update_condition()
        if self._condition.kind != "ready":
            raise ControlRefused(self._condition.sentence)
        with Dashboard(self._name, self._facts.address) as dashboard:
            if not dashboard.is_remote:
                raise ControlRefused(
                    f"{self._name} is in local control: switch its panel to remote control (upper right corner)"
                )
        self._program = UrProgram(self._facts, self.period_s, self._connected)
        try:
            self._program.start(self._load)
            self._tare_once(self._program)
        except ControlRefused:
            self.give_back()
            raise
        self._mode = mode
        self._update_condition()

    def give_back(self) -> None:
        """Let the controller brake, end the program, and disconnect; a silent controller brakes by its watchdog."""
        program, mode, self._program, self._mode = self._program, self._mode, None, None
        if program is None:
            return
        states = self._connected
        if states.is_alive() and not program.has_ended:
            program.end(mode)
            states.await_that(lambda: not states.executes, RELEASE_S)
        self._leaving.leave(program.connection)
        self._update_condition()

    def recover(self) -> None:
        """Leave a program that has ended, and release a protective stop; StopPersists, with what somebody has to do."""
        kind = self._condition.kind
        if kind == "emergency-stop":
            raise StopPersists(self._condition.sentence)
        if kind != "in-control":
            self.give_back()
        if kind != "protective-stop":
            return
        with Dashboard(self._name, self._facts.address) as dashboard:
            if (refusal := dashboard.release_protective_stop()) is not None:
                raise StopPersists(f"{self._name} does not release its protective stop: {refusal}")
        states = self._connected
        states.await_that(lambda: states.can_move, RELEASE_S)
        self._condition = found = states.read_condition(controls=False)
        if found.kind != "ready":
            raise StopPersists(found.sentence)

    def set_load(self, hand: PointMass, held: PointMass) -> None:
        """Set the payload of the controller, which subtracts its weight from the wrench: hand and what it holds."""
        self._load = _together(hand, held)
        if self._program is not None:
            self._program.set_load(self._load)

    def tare(self) -> None:
        """Let the wrench that is measured now be 0; ControlRefused without control."""
        if self._program is None:
            raise ControlRefused(f"{self._name} sets its sensor to 0 only under control: {self._condition.sentence}")
        self._offset[:] = self._program.tare()

    def close(self) -> None:
        """Give control back and disconnect."""
        with suppress(Exception):
            self.give_back()
        for each in (self._program, self._states):
            if each is not None:
                self._leaving.leave(each.connection)
        self._program = self._states = self._mode = None
        self._leaving.wait(CLOSE_S)
        self._condition = DeviceCondition("wrong-mode", f"{self._name} is not connected")

    @property
    def _connected(self) -> UrStates:
        if self._states is None:
            raise LinkLost(f"{self._name} is not connected")
        return self._states

    def _update_condition(self) -> None:
        states, program = self._connected, self._program
        is_others = program is None or (program.has_ended and states.executes)
        found = states.read_condition(controls=not is_others)
        if program is not None and self._mode is not None:
            program.has_ended = program.has_ended or found.kind == "not-in-control"
            if found.kind == "in-control" and (contradiction := program.find_contradiction()) is not None:
                found = DeviceCondition("wrong-mode", contradiction)
        if found != self._condition:
            self._condition = found

    def _tare_once(self, program: UrProgram) -> None:
        """Let the first wrench of a connection be 0, if it can be the offset of the sensor; ControlRefused."""
        if self._is_tared or not self.abilities.tares:
            return
        if (problem := program.explain_force()) is not None:
            raise ControlRefused(problem)
        self._offset[:] = program.tare()
        self._is_tared = True


def _together(one: PointMass, other: PointMass) -> PointMass:
    """Return two masses as one, at their common centre."""
    mass = one.mass_kg + other.mass_kg
    if mass <= 0.0:
        return NO_MASS
    return PointMass(mass, (one.mass_kg * one.centre + other.mass_kg * other.centre) / mass)


class Dashboard:
    """A connection for a few questions; it needs no library and never waits for longer than `TIMEOUT_S`."""

    def __init__(self, name: str, address: str) -> None:
        """Connect to the controller of an arm called `name`; BackendUnavailable if it does not answer."""
        self._name = name
        try:
            self._socket: socket = create_connection((address, PORT), timeout=TIMEOUT_S)
            self._lines = self._socket.makefile("r", encoding="utf-8", newline="\n")
            self._lines.readline()
        except OSError as error:
            raise BackendUnavailable(
                f"the dashboard server of {name} (port {PORT}) does not answer ({error.strerror or error}): is the "
                "controller on, is the address right (skiros:DriverAddress), and is the service enabled in its "
                "security settings?"
            ) from error

    def __enter__(self) -> Dashboard:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self._socket.close()

    @property
    def version(self) -> tuple[int, int]:
        """The version of PolyScope."""
        answer = self.ask("PolyscopeVersion")
        if (found := re.search(r"(\d+)\.(\d+)\.", answer)) is None:
            raise BackendUnavailable(f"{self._name} does not tell its version of PolyScope: {answer!r}")
        return int(found[1]), int(found[2])

    @property
    def is_remote(self) -> bool:
        """Whether the controller takes programs from outside; versions that do not know the question do."""
        return "false" not in self.ask("is in remote control").lower()

    def release_protective_stop(self) -> str | None:
        """Release a protective stop; return why that is refused, None if it is not."""
        answer = self.ask("unlock protective stop")
        return None if "releasing" in answer.lower() else answer

    def ask(self, line: str) -> str:
        """Send a line and return the answer; BackendUnavailable if there is none."""
        try:
            self._socket.sendall(f"{line}\n".encode())
            return self._lines.readline().strip()
        except OSError as error:
            why = error.strerror or error
            raise BackendUnavailable(f"the dashboard server of {self._name} has gone silent: {why}") from error
