"""A Franka Hand as a gripper: opened by moves, closed by grasps with a force."""

from __future__ import annotations

import json
import subprocess
import sys
from contextlib import suppress
from functools import partial
from threading import Event, Thread
from time import monotonic
from typing import Any, Final

from skillc_runtime.backends.control_process.remote.remote_arm import RemoteArmDriver
from skillc_runtime.backends.devices.measured_gripper import MeasuredGripper
from skillc_runtime.backends.simulation.scene_spec import GripperSpec
from skillc_runtime.devices.backend import BackendUnavailable, StopPersists

PROGRAM: Final = "skillc_runtime.backends.franka.hand_process"

IDLE_SILENCE_S: Final = 3.0
MOVING_SILENCE_S: Final = 10.0
"""A hand that says nothing for longer does not answer: while nothing is to be done, and while fingers move, in s."""

CONNECT_S = 10.0
"""How long the hand may take to answer first, with the start of its process, in s."""

STOP_S = 2.0
"""How long fingers may take to stop, in s."""

HOMED_SHARE = 0.9
"""Fingers that have not been homed do not know how far they open: they say less than this share of the data sheet's."""


class FrankaHand(MeasuredGripper):
    """The hand of one robot.

    While its fingers move, the library reports nothing of them, so `opening_m` is that from before. To stop them, the
    process that waits for them is ended, and another one, which is ready, connects and stops them.
    """

    def __init__(self, facts: GripperSpec, address: str, arm: RemoteArmDriver) -> None:
        """Connect; nothing moves. BackendUnavailable, with what to do."""
        super().__init__(f"the hand at {address}", facts, arm.hold, partial(arm.set_load, None))
        self._address = address
        self._client = HandClient(address)
        self._spare = HandClient(address)
        self._goal_m = 0.0
        try:
            self._connect()
        except BackendUnavailable:
            self.close()
            raise

    @property
    def opening_m(self) -> float:
        """The distance between the fingers in m, as measured when they were at rest last."""
        return self._client.opening_m

    @property
    def moving(self) -> bool:
        """Whether the fingers still move towards the commanded opening."""
        return self._client.busy

    @property
    def blocked(self) -> bool:
        """Whether the fingers rest, wider than their commanded opening."""
        return not self.moving and self.opening_m > self._goal_m + self.opening_error_m

    @property
    def fault(self) -> str | None:
        """Why the hand cannot go on; None while it can."""
        return self._client.fault or None

    def move(self, opening_m: float, force_n: float) -> None:
        """Move the fingers to an opening in m, closing with a force in N; returns at once."""
        if self.moving:
            self.stop()
        speed = self._facts.finger_speed_m_s
        self._goal_m = min(max(opening_m, 0.0), self._facts.max_opening_m)
        if self._goal_m < self.opening_m:
            self._client.order("grasp", self._goal_m, speed, min(force_n, self._facts.max_force_n))
        else:
            self._client.order("move", min(self._goal_m, self._client.widest_m), speed)

    def stop(self) -> None:
        """Stop the fingers at their present opening."""
        if self.moving:
            self._replace_client()
            self._client.order("connect", self._address)
            self._client.order("stop")
            self._client.wait(STOP_S)
            self._goal_m = self.opening_m

    def recover(self) -> None:
        """Connect again after a fault; StopPersists."""
        if self.fault is not None:
            self._replace_client()
            try:
                self._connect()
            except BackendUnavailable as error:
                raise StopPersists(str(error)) from error

    def close(self) -> None:
        """Disconnect; the fingers go on with their last command."""
        self._client.close()
        self._spare.close()

    def _replace_client(self) -> None:
        self._client.close()
        opening_m, widest_m = self._client.opening_m, self._client.widest_m
        self._client, self._spare = self._spare, HandClient(self._address)
        self._client.opening_m, self._client.widest_m = opening_m, widest_m

    def _connect(self) -> None:
        self._client.order("connect", self._address)
        self._client.wait(CONNECT_S)
        if self._client.fault or self._client.busy:
            reason = self._client.error or f"it has not answered for {CONNECT_S:g} s"
            raise BackendUnavailable(
                f"there is no connection to {self._name} ({reason}): is a Franka Hand set as end effector in Desk?"
            )
        if self._client.widest_m < HOMED_SHARE * self._facts.max_opening_m:
            raise BackendUnavailable(
                f"{self._name} says that it opens to {1e3 * self._client.widest_m:.0f} mm, not to "
                f"{1e3 * self._facts.max_opening_m:.0f} mm: home it in Desk"
            )
        self._goal_m = self.opening_m


class HandClient:
    """One process; it has loaded the library at once, and connects when it is ordered to."""

    def __init__(self, address: str) -> None:
        self.address = address
        self.opening_m, self.widest_m, self.error = 0.0, 0.0, ""
        self._ordered = self._done = 0
        self._said_s, self._news = monotonic(), Event()
        self._process = subprocess.Popen(
            [sys.executable, "-m", PROGRAM],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        Thread(target=self._listen, name=f"hand {address}", daemon=True).start()

    @property
    def busy(self) -> bool:
        """Whether an order is still carried out; none is without an answer."""
        return self._done < self._ordered and not self.fault

    @property
    def fault(self) -> str:
        """Why the hand cannot go on; empty while it can."""
        if self.error:
            return f"the hand at {self.address} reports an error: {self.error}"
        silent_s = monotonic() - self._said_s
        if silent_s > (MOVING_SILENCE_S if self._done < self._ordered else IDLE_SILENCE_S):
            return f"the hand at {self.address} has not answered for {silent_s:.1f} s"
        return ""

    def order(self, name: str, *arguments: Any) -> None:
        """Let the hand do something once it has done all before; returns at once."""
        self._ordered += 1
        self._said_s = monotonic()
        assert self._process.stdin is not None
        with suppress(OSError):  # The process has ended; `fault` says so.
            print(json.dumps([name, *arguments]), file=self._process.stdin, flush=True)

    def wait(self, limit_s: float) -> None:
        """Wait until all orders are carried out, or the hand cannot go on, or a time in s has passed."""
        until = monotonic() + limit_s
        while self.busy and (left := until - monotonic()) > 0.0:
            self._news.wait(left)
            self._news.clear()

    def close(self) -> None:
        """End the process, whatever it waits for."""
        self._process.kill()
        self._process.wait()  # wait ends: it is killed

    def _listen(self) -> None:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            said = json.loads(line)
            self.opening_m, self.widest_m = said.get("opening", self.opening_m), said.get("max", self.widest_m)
            self.error = said.get("error", self.error)
            self._done, self._said_s = said["done"], monotonic()
            self._news.set()
        self.error = self.error or "its process has ended"
        self._news.set()
