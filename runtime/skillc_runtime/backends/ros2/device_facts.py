"""Reads facts about one device that ROS 2 drives: names, numbers and choices of the vocabulary `ros2`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeVar

from skillc_runtime.world.state.data_sheet import SheetError, number_of, sheet_of
from skillc_runtime.world.state.terms import ROS2, SKIROS, STATE_TIMEOUT
from skillc_runtime.world.state.world_state import WorldState

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Timing:
    """How long the first message is waited for, and after which silence a device is lost, in s."""

    connect_s: float
    silence_s: float


@dataclass(frozen=True, slots=True)
class Quality:
    """Whether the delivery of states and of commands is reliable, or best effort."""

    reliable_states: bool
    reliable_commands: bool


@dataclass(frozen=True, slots=True)
class DeviceFacts:
    """The facts of one device; what it does not state, its data sheet may."""

    state: WorldState
    individual: str

    @property
    def name(self) -> str:
        """The device's short name."""
        return self.state.vocabulary.short(self.individual)

    def text(self, name: str, default: str = "") -> str:
        """Return a text by its name in the vocabulary `ros2`."""
        found = self._find(ROS2 + name)
        return default if found is None else str(found)

    def number(self, name: str, default: float) -> float:
        """Return a number by its name in the vocabulary `ros2`, in SI units."""
        return number_of(self.state, self._owner(ROS2 + name), ROS2 + name, default)

    def choice(self, name: str, choices: Mapping[str, T], default: T) -> T:
        """Return what a text stands for; SheetError with all choices for any other text."""
        if not (text := self.text(name)):
            return default
        if text not in choices:
            raise SheetError(f"ros2:{name} of {self.name} is {text!r}; it is {' or '.join(map(repr, choices))}")
        return choices[text]

    def flag(self, name: str) -> bool | None:
        """Return a truth value by its name in the vocabulary `ros2`; None if it is not stated."""
        found = self._find(ROS2 + name)
        return found if isinstance(found, bool) else None

    def topic(self, name: str, default: str = "") -> str:
        """Return the full name of a topic or service; empty if there is neither a fact nor a default."""
        return self.full_name(self.text(name, default))

    def skiros(self, name: str) -> str:
        """Return a text by its name in the vocabulary `skiros`; empty if it is not stated."""
        found = self._find(SKIROS + name)
        return "" if found is None else str(found)

    def full_name(self, topic: str) -> str:
        """Return a topic below the namespace of the device, unless its name begins with a slash; empty for empty."""
        if not topic or topic.startswith("/"):
            return topic
        return "/" + "/".join(filter(None, (self.text("namespace").strip("/"), topic)))

    def timing(self, silence_s: float) -> Timing:
        """Return how long the device is waited for."""
        stated_s = number_of(self.state, self._owner(STATE_TIMEOUT), STATE_TIMEOUT, silence_s)
        return Timing(self.number("connectTimeout", 10.0), stated_s)

    def quality(self) -> Quality:
        """Return how its messages are delivered."""
        kinds = {"reliable": True, "best-effort": False}
        return Quality(
            reliable_states=self.choice("stateReliability", kinds, False),
            reliable_commands=self.choice("commandReliability", kinds, True),
        )

    def joints(self, of_model: tuple[str, ...]) -> tuple[str, ...]:
        """Return the names of the joints in ROS; SheetError if they are not as many as those of the model."""
        names = tuple(self.text("jointNames").split()) or of_model
        if len(names) != len(of_model) or len(set(names)) != len(names):
            raise SheetError(
                f"ros2:jointNames of {self.name} has {len(set(names))} names; its model has {len(of_model)} joints: "
                f"{' '.join(of_model)}"
            )
        return names

    def _owner(self, property_: str) -> str:
        if self.state.value(self.individual, property_) is not None:
            return self.individual
        try:
            return sheet_of(self.state, self.individual).individual
        except SheetError:
            return self.individual

    def _find(self, property_: str) -> object:
        return self.state.value(self._owner(property_), property_)
