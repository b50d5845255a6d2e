"""Puts the joints of `sensor_msgs/msg/JointState`, which has them by name and in any order, in the order of a model."""

from __future__ import annotations

from typing import Any

import numpy as np

from skillc_runtime.motion.pose import Array


class JointOrder:
    """The joints of one device by their names in ROS, as the last messages have had them."""

    def __init__(self, names: tuple[str, ...]) -> None:
        self.names, self.known = names, np.zeros(len(names), dtype=bool)
        self.values = np.full((3, len(names)), np.nan)
        self.seen: list[str] | None = None
        self._from, self._to = np.zeros(0, dtype=int), np.zeros(0, dtype=int)

    def read(self, message: Any) -> bool:
        """Take what a message has of these joints; return whether it has any.

        A joint without a speed or an effort in the message has NaN there.
        """
        if message.name != self.seen:
            self._learn(list(message.name))
        if self._from.size == 0:
            return False
        for row, numbers in zip(self.values, (message.position, message.velocity, message.effort), strict=True):
            row[self._to] = np.frombuffer(numbers)[self._from] if len(numbers) == len(message.name) else np.nan
        self.known[self._to] = True
        return True

    @property
    def missing(self) -> tuple[str, ...]:
        """The joints that no message has had yet."""
        return tuple(name for name, known in zip(self.names, self.known, strict=True) if not known)

    def describe_missing(self, topic: str) -> str:
        """Return which joints the messages of a topic lack; empty if they lack none, or none has come."""
        if self.seen is None or not self.missing:
            return ""
        return f"{topic} has no {', '.join(self.missing)}, but {', '.join(self.seen)} (ros2:jointNames)"

    @property
    def positions(self) -> Array:
        """The positions (n,) in rad or m; not a copy."""
        row: Array = self.values[0]
        return row

    def _learn(self, names: list[str]) -> None:
        found = [(names.index(name), place) for place, name in enumerate(self.names) if name in names]
        self.seen = names
        self._from, self._to = (np.array([pair[k] for pair in found], dtype=int) for k in range(2))
