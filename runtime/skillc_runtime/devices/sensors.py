"""Interfaces of a camera, buttons, inputs and outputs of a cell, simulated or real."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.motion.dirt_map import DirtMap
from skillc_runtime.world.state.facts import Evidence

if TYPE_CHECKING:
    from skillc_runtime.vision.classify_part import ClassifiedPart


class Camera(Protocol):
    """A camera that inspects surfaces and parts."""

    @property
    def evidence(self) -> Evidence:
        """How what it returns is known: sensed, or idealised by a camera that sees no picture."""
        return "sensed"

    def request(self) -> None:
        """Let the next inspection be of what is there from now on; called before it, when nothing moves any more."""
        return

    @property
    def waits_for(self) -> str:
        """What has not come yet since `request`, for a message; empty if an inspection is possible."""
        return ""

    def inspect(self, surface: str) -> float:
        """Return the share of a surface, by IRI, that is clean; KeyError if there is no such surface."""
        ...

    def dirt_map(self, surface: str) -> DirtMap | None:
        """Return which cells of a surface, by IRI, the last inspection showed clean; None if it only told a share."""
        return None

    def classify(self, part: str) -> ClassifiedPart:
        """Return what an image that is taken now shows of a part, by IRI.

        NoSuchDevice, with the reason, if it does not decide, or if this camera takes no images.
        """
        raise NoSuchDevice("the inspection camera takes no images, without which nothing is known of parts")

    def rubbed_share(self, surface: str, seconds: float) -> float:
        """Return the share of a surface that was rubbed for at least `seconds`.

        KeyError if there is no such surface.
        """
        ...


class Button(Protocol):
    """A button, for example one that starts a machine."""

    @property
    def switched(self) -> bool:
        """Whether it is pressed so far that it has switched."""
        ...


class IoPoint(Protocol):
    """An input or output of a controller: 0 or 1 of a digital one, a number in its unit of an analogue one."""

    @property
    def level(self) -> float:
        """The level that the controller reports: 0 or 1, or V or A of an analogue one."""
        ...

    def set(self, level: float) -> None:
        """Set an output to 0 or 1, or V of an analogue one; ValueError if it cannot have that level,
        NotOffered for an input."""
        ...
