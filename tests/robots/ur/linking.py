"""What tests of the link do in place of the control process: read and write in turn."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import Any, TypeAlias

import numpy as np

from robots.ur.peer import Peer
from skillc_ontology.catalogue import model_path
from skillc_runtime.backends.control_process.link import KINDS, CommandView, StateView, make_command, make_state
from skillc_runtime.backends.ur.facts import ServoFacts, UrFacts
from skillc_runtime.backends.ur.link import UrLink
from skillc_runtime.devices.arm import Mode
from skillc_runtime.motion.pose import Array

QUICK = ServoFacts(gain=2000.0, lookahead_s=0.03, acceleration_rad_s2=20.0, stop_rad_s2=20.0)


Wanted: TypeAlias = Callable[[int, StateView], Array]


def describe(host: str, **changes: Any) -> UrFacts:
    """Return an arm at an address, with other facts where they are given; time-outs are long, for busy machines."""
    facts = UrFacts(
        arm="Ur5e-1",
        address=host,
        servo=QUICK,
        silence_s=0.5,
        command_timeout_s=1.0,
        model=model_path("robots/ur5e.xml"),
        tolerance_m=0.005,
        tolerance_rad=0.02,
        offset_n=40.0,
    )
    return replace(facts, **changes)


class Loop:
    """A link with its state and its command."""

    def __init__(self, link: UrLink) -> None:
        self.link, self.state, self.command = link, make_state(6), make_command(6)

    def run(
        self, cycles: int, wanted: Callable[[int, StateView], Array] | None = None, mode: Mode = "position"
    ) -> None:
        """Run cycles of the controller; `wanted` gives the values (6,) of the command of each."""
        for cycle in range(cycles):
            self.link.read(self.state)
            if wanted is not None and self.link.condition.kind == "in-control":
                send(self.link, self.command, mode, wanted(cycle, self.state))


def send(link: UrLink, command: CommandView, mode: Mode, values: Array) -> None:
    """Write a command."""
    command.kind[0] = KINDS.index(mode)
    command.values[:] = values
    link.write(command)


@contextmanager
def connected(peer: Peer, **changes: Any) -> Iterator[Loop]:
    """Connect to a controller, with other facts where they are given."""
    link = UrLink(describe(peer.host, **changes))
    link.connect()
    try:
        loop = Loop(link)
        loop.run(1)
        yield loop
    finally:
        link.close()


def swing(start: Array, joint: int, way: float, cycles: int) -> Wanted:
    """Return positions of a joint that goes a way in rad and comes back, smoothly, within so many cycles."""

    def at(cycle: int, _state: StateView) -> Array:
        q = start.copy()
        q[joint] += way / 2.0 * (1.0 - np.cos(2.0 * np.pi * min(cycle, cycles) / cycles))
        return q

    return at
