"""Options and report of a simulated robot, and the channel that loses and delays its messages."""

from __future__ import annotations

import random
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from heapq import heappop, heappush
from itertools import count
from typing import Literal


@dataclass(frozen=True)
class Options:
    """What the peer is.

    panel: the file of the socket at which it is asked what is true; none if it is empty. library: the shipped one
    whose terms the scene has. rate_hz: how often states are published and commands taken. control: the controllers
    that are active. loss: the share of messages that get lost, in each direction; jitter_s: the greatest delay of
    those that do not. reverse: joint states are in reverse order. described: the robot publishes its URDF. shuffled:
    its controller of positions has its joints as a parameter, and takes them in reverse order. degrees: states are in
    degrees, as no driver should publish them. seed: draws what is lost and delayed. seconds: after which the process
    ends.
    """

    scene: str
    report: str = ""
    panel: str = ""
    library: str = ""
    rate_hz: float = 250.0
    control: Literal["position", "velocity", "effort", "trajectory", "cartesian", "none"] = "position"
    joint_names: dict[str, str] = field(default_factory=dict)
    described: bool = False
    shuffled: bool = False
    loss: float = 0.0
    jitter_s: float = 0.0
    reverse: bool = False
    degrees: bool = False
    seed: int = 0
    seconds: float = 600.0


@dataclass
class Report:
    """What the peer has recorded: commands beyond limits (the first ones as text), lost messages, and held objects."""

    commands: int = 0
    beyond_limits: int = 0
    examples: list[str] = field(default_factory=list)
    lost: int = 0
    holds: dict[str, str] = field(default_factory=dict)

    def complain(self, problem: str) -> None:
        """Count a command beyond a limit."""
        self.beyond_limits += 1
        if len(self.examples) < 5:
            self.examples.append(problem)


class Channel:
    """Loses and delays messages."""

    def __init__(self, options: Options, report: Report) -> None:
        self._options, self._report, self._random = options, report, random.Random(options.seed)
        self._waiting: list[tuple[float, int, Callable[[], None]]] = []
        self._number = count()

    def carry(self, deliver: Callable[[], None]) -> None:
        """Deliver a message now, later or never."""
        if self._random.random() < self._options.loss:
            self._report.lost += 1
            return
        if self._options.jitter_s == 0.0:
            deliver()
            return
        due = time.monotonic() + self._random.random() * self._options.jitter_s
        heappush(self._waiting, (due, next(self._number), deliver))

    def deliver_due(self) -> None:
        """Deliver what is due."""
        while self._waiting and self._waiting[0][0] <= time.monotonic():
            heappop(self._waiting)[2]()
