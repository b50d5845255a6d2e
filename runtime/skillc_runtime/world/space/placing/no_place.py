"""Says why there is no free place on a carrier: how much room there is and is needed, and what is in the way."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, TypeAlias

import msgspec

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.supports import Support, name_support, tilt_deg
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

Lack: TypeAlias = Literal["size", "support", "room", "free room", "clearance", "headroom", "reach"]

LEVEL_DEG = 1.0
"""What is tilted less is level."""

NEAR_BASE_M = 0.25
"""Nothing is put down nearer to the axis of an arm's base."""

REACH_SHARE = 0.95
"""Things are put down within this share of the reach of an arm, measured from its shoulder, if there is room."""

MOST_NAMED = 3
"""How many things that are in the way are named."""


class PlaceError(EvaluationError):
    """A thing cannot be put down; the message says why, with numbers, and `lack` what there is not."""

    def __init__(self, message: str, lack: Lack = "support") -> None:
        super().__init__(message)
        self.lack = lack


class Neighbour(msgspec.Struct, frozen=True, eq=False):
    """A solid of what takes up room: its lowest and highest corner (3,) in m, in the frame of a support.

    lies_there: whether it lies free, with its middle over the support.
    """

    individual: str
    low: Array
    high: Array
    lies_there: bool


class WantedRoom(msgspec.Struct, frozen=True, eq=False):
    """Room on a support for a thing; the methods say why there is none.

    size: the sides (2,) of the thing in m. needed: the sides (2,) in m of the room for the thing and the hand.
    """

    state: WorldState
    support: Support
    size: Array
    needed: Array

    def describe_misfit(self) -> PlaceError:
        """Return that the thing is too large for the support."""
        return PlaceError(
            f"{_shown(self.size)} do not fit into {self._where}, which is {_shown(2.0 * self.support.half)}: "
            f"with room for the hand they need {_shown(np.ceil(1e3 * self.needed - 1e-6) / 1e3)}",
            "room",
        )

    def describe_blocked(self, blockers: Sequence[Neighbour]) -> PlaceError:
        """Return what is in the way wherever the thing would be put."""
        names = sorted({self.state.vocabulary.short(each.individual) for each in blockers})
        more = f" and {len(names) - MOST_NAMED} more" if names[MOST_NAMED:] else ""
        listed = " and ".join(names[:MOST_NAMED]) + more
        wide, tilt = _shown(self.size), tilt_deg(self.support)
        if any(each.lies_there for each in blockers):
            room = f"with the hand it takes {_shown(self.needed)} of {_shown(2.0 * self.support.half)}"
            return PlaceError(
                f"{self._where} is full: no place of {wide} is free beside {listed}, and {room}", "free room"
            )
        if tilt > LEVEL_DEG:
            return PlaceError(
                f"{self._where} is tilted by {tilt:.0f} deg, and no place of {wide} on it is clear of {listed}"
            )
        return PlaceError(f"no place of {wide} on {self._where} is clear of {listed}", "clearance")

    def describe_distance(self, arm: str, reach_m: float, distances_m: Sequence[float]) -> PlaceError:
        """Return that the free places are too far from the shoulder of an arm, or too near to its base."""
        short = self.state.vocabulary.short(arm)
        if min(distances_m) < reach_m:
            return PlaceError(
                f"every free place on {self._where} is less than {NEAR_BASE_M:g} m from the base of {short}, or more "
                f"than {reach_m:.2f} m, its reach, from its shoulder",
                "reach",
            )
        return PlaceError(
            f"no free place on {self._where} is within the {reach_m:.2f} m that {short} reaches: "
            f"the nearest is {min(distances_m):.2f} m from its shoulder",
            "reach",
        )

    @property
    def _where(self) -> str:
        return name_support(self.state, self.support)


def _shown(sides: Array) -> str:
    return f"{1e3 * sides[0]:.0f} x {1e3 * sides[1]:.0f} mm"
