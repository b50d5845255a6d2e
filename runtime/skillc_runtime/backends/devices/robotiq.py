"""Grippers of Robotiq behind the socket that their URCap opens on the controller of the arm (port 63352).

Variables of one byte are set and asked by name: `SET POS 255` is answered with `ack`, `GET POS` with `POS 255`. POS is
0 with open fingers, and grows as they close; OBJ is 0 while they move, 1 and 2 when something stopped them while they
opened and closed, 3 at the commanded position; STA is 3 once the gripper is activated; FLT is 0 without fault.
"""

from __future__ import annotations

from time import monotonic, sleep

from skillc_runtime.backends.devices.fingers import FingerDevice, FingersLost, FingerState
from skillc_runtime.backends.devices.text_line import TextLine, split_address
from skillc_runtime.backends.simulation.scene_spec import GripperSpec
from skillc_runtime.devices.backend import BackendUnavailable

PORT = 63352

STEPS = 255
"""The steps of position, force and speed, unless the sheet says how many the opening has."""

ACTIVE, ACTIVATION_S = 3, 10.0
"""The status of an activated gripper, and how long its activation, in which the fingers move, is waited for in s."""

MOVING, BLOCKED_CLOSING = 0, 2


class RobotiqFingers(FingerDevice):
    """One gripper; `steps`: the position with closed fingers."""

    def __init__(self, name: str, address: str, facts: GripperSpec, steps: int = STEPS) -> None:
        host, port = split_address(address, PORT)
        self._name, self._facts, self._steps = f"{name} at {host}:{port}", facts, steps
        self._line = TextLine(self._name, host, port)

    @property
    def name(self) -> str:
        """The gripper and its address."""
        return self._name

    def connect(self) -> None:
        """Connect."""
        self._line.open("is the URCap of the gripper installed, and is the address that of the arm's controller?")

    def activate(self) -> None:
        """Activate the gripper unless it is active; then its fingers open and close once."""
        try:
            if self._get("STA") != ACTIVE:
                self._set(ACT=0)
                self._set(ACT=1)
                self._await_activation()
        except FingersLost as lost:
            raise BackendUnavailable(str(lost)) from lost

    def read(self) -> FingerState:
        """Return its state."""
        if (fault := self._get("FLT")) != 0:
            raise FingersLost(f"{self._name} reports fault {fault}")
        met = self._get("OBJ")
        opening = self._facts.max_opening_m * (1.0 - self._get("POS") / self._steps)
        return FingerState(max(opening, 0.0), met == MOVING, met == BLOCKED_CLOSING)

    def move(self, opening_m: float, force_n: float) -> None:
        """Begin to move the fingers."""
        position = round(self._steps * (1.0 - opening_m / self._facts.max_opening_m))
        force = round(STEPS * force_n / self._facts.max_force_n)
        self._set(POS=position, SPE=STEPS, FOR=force, GTO=1)
        self._await_request(position)

    def stop(self) -> None:
        """Stop the fingers where they are."""
        self._set(GTO=0)

    def close(self) -> None:
        """Disconnect."""
        self._line.close()

    def _await_activation(self) -> None:
        until = monotonic() + ACTIVATION_S
        while self._get("STA") != ACTIVE:
            if monotonic() > until:
                raise FingersLost(f"{self._name} is not activated within {ACTIVATION_S:g} s")
            sleep(0.05)

    def _await_request(self, position: int) -> None:
        """Wait until the gripper has taken a position: what it says about obstacles is of the one before until then."""
        until = monotonic() + 1.0
        while self._get("PRE") != position:
            if monotonic() > until:
                raise FingersLost(f"{self._name} does not take the position {position}")
            sleep(0.005)

    def _set(self, **values: int) -> None:
        words = " ".join(f"{name} {value}" for name, value in values.items())
        if (answer := self._ask(f"SET {words}")) != "ack":
            raise FingersLost(f"{self._name} does not take {words}: {answer!r}")

    def _get(self, name: str) -> int:
        answer = self._ask(f"GET {name}")
        told, _, value = answer.partition(" ")
        if told != name or not value.isdigit():
            raise FingersLost(f"{self._name} answers {answer!r} to GET {name}")
        return int(value)

    def _ask(self, line: str) -> str:
        try:
            self._line.send(line)
            return self._line.receive_word()
        except OSError as error:
            raise FingersLost(f"{self._name} does not answer: {error}") from error
