"""Grippers of the WSG series by Schunk and Weiss Robotics, by their text protocol, the Gripper Control Language.

Lines ask and order: `POS?` is answered with `POS=55.0`, an order with `ACK` and its name, and with `FIN` or `ERR` and
its name when it has ended. Lengths are in mm. GRIPSTATE: 0 idle, 1 gripping, 2 no part, 3 part lost, 4 holding, 5
releasing, 6 positioning, 7 error. Text interfaces are off until they are enabled in the gripper's web page.
"""

from __future__ import annotations

from skillc_runtime.backends.devices.fingers import FingerDevice, FingersLost, FingerState
from skillc_runtime.backends.devices.text_line import TextLine, split_address
from skillc_runtime.backends.simulation.scene_spec import GripperSpec
from skillc_runtime.devices.backend import BackendUnavailable

PORT = 1000

GRIPPING, PART_LOST, HOLDING, RELEASING, POSITIONING, ERROR = 1, 3, 4, 5, 6, 7
"""States of grasping."""

CLOSED_M = 0.001
"""Fingers that are to close to less are to grip."""


class WsgFingers(FingerDevice):
    """One gripper."""

    def __init__(self, name: str, address: str, facts: GripperSpec) -> None:
        host, port = split_address(address, PORT)
        self._name, self._facts = f"{name} at {host}:{port}", facts
        self._line = TextLine(self._name, host, port)
        self._order = ""

    @property
    def name(self) -> str:
        """The gripper and its address."""
        return self._name

    def connect(self) -> None:
        """Connect."""
        self._line.open("is the text based interface enabled in its web page, and is the address right?")
        self._order = ""

    def activate(self) -> None:
        """Acknowledge a fast stop, if there was one."""
        try:
            self._send("FSACK()")
            self._receive("ACK FSACK", "FIN FSACK")
        except FingersLost as lost:
            raise BackendUnavailable(str(lost)) from lost

    def read(self) -> FingerState:
        """Return its state."""
        opening, state = self._ask("POS") / 1e3, round(self._ask("GRIPSTATE"))
        if state == ERROR:
            raise FingersLost(f"{self._name} reports an error")
        moving = bool(self._order) or state in (GRIPPING, RELEASING, POSITIONING)
        return FingerState(max(opening, 0.0), moving, state == HOLDING)

    def move(self, opening_m: float, force_n: float) -> None:
        """Begin to grip, to open from a grip, or to move the fingers."""
        here, state = self._ask("POS") / 1e3, round(self._ask("GRIPSTATE"))
        if opening_m < CLOSED_M:
            order = f"GRIP({force_n:.1f})"
        elif state in (HOLDING, PART_LOST) and opening_m > here:
            order = f"RELEASE({1e3 * (opening_m - here):.1f})"
        else:
            order = f"MOVE({1e3 * opening_m:.1f})"
        self._begin(order)

    def stop(self) -> None:
        """Stop the fingers where they are."""
        self._begin("STOP()")

    def close(self) -> None:
        """Disconnect."""
        self._line.close()

    def _begin(self, order: str) -> None:
        name = order.partition("(")[0]
        self._send(order)
        self._order = name
        self._receive(f"ACK {name}")

    def _ask(self, name: str) -> float:
        self._send(f"{name}?")
        answer = self._receive(f"{name}=")
        try:
            return float(answer.partition("=")[2])
        except ValueError:
            raise FingersLost(f"{self._name} answers {answer!r} to {name}?") from None

    def _send(self, line: str) -> None:
        try:
            self._line.send(line)
        except OSError as error:
            raise FingersLost(f"{self._name} does not answer: {error}") from error

    def _receive(self, *wanted: str) -> str:
        """Return the first line that begins with the last of `wanted`; take notice of orders that end meanwhile."""
        while True:
            try:
                line = self._line.receive()
            except OSError as error:
                raise FingersLost(f"{self._name} does not answer: {error}") from error
            word, _, name = line.partition(" ")
            if word in ("FIN", "ERR") and name.split(" ")[0] == self._order:
                self._order = ""
            if line.startswith(wanted[-1]):
                return line
            if word == "ERR" and wanted[-1].split(" ")[-1] == name.split(" ")[0]:
                raise FingersLost(f"{self._name} refuses: {line}")
