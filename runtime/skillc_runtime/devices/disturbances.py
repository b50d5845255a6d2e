"""What can happen to a simulated cell that no skill does, as values that are recorded. Devices and things are IRIs."""

from __future__ import annotations

from typing import Annotated, Protocol, TypeAlias

import msgspec

MAX_PUSH_N, MAX_PUSH_S, MAX_MOVE_M, MAX_TURN_RAD = 1000.0, 60.0, 10.0, 6.3
Newton = Annotated[float, msgspec.Meta(ge=-MAX_PUSH_N, le=MAX_PUSH_N)]
Metre = Annotated[float, msgspec.Meta(ge=-MAX_MOVE_M, le=MAX_MOVE_M)]
Name = Annotated[str, msgspec.Meta(min_length=1, max_length=500)]


class DisturbanceRefused(ValueError):
    """A disturbance is not possible in a cell; the message says why, and nothing has changed."""


class _Disturbance(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    pass


class PushArm(_Disturbance, tag="push", frozen=True):
    """Somebody pushes the hand of an arm with a force (x, y, z) in N in the world, from now on for `duration_s` s."""

    arm: Name
    force_n: tuple[Newton, Newton, Newton]
    duration_s: Annotated[float, msgspec.Meta(gt=0.0, le=MAX_PUSH_S)] = 0.5


class MoveThing(_Disturbance, tag="move", frozen=True):
    """Somebody moves a thing by (x, y, z) in m in the world, and turns it about the vertical, in rad."""

    thing: Name
    by_m: tuple[Metre, Metre, Metre]
    turn_rad: Annotated[float, msgspec.Meta(ge=-MAX_TURN_RAD, le=MAX_TURN_RAD)] = 0.0


class TakeThing(_Disturbance, tag="take", frozen=True):
    """Somebody takes a thing out of the hand that holds it, moves it by (x, y, z) in m in the world, and lets it go."""

    thing: Name
    by_m: tuple[Metre, Metre, Metre] = (0.0, 0.3, 0.0)


class PressEmergencyStop(_Disturbance, tag="emergency-stop", frozen=True):
    """Somebody presses an emergency stop, or releases it."""

    pressed: bool = True


class LoseArm(_Disturbance, tag="lost-arm", frozen=True):
    """An arm does not answer any more, or answers again; it stands still meanwhile."""

    arm: Name
    lost: bool = True


Disturbance: TypeAlias = PushArm | MoveThing | TakeThing | PressEmergencyStop | LoseArm


class Disturber(Protocol):
    """Lets things happen to a simulated cell."""

    def disturb(self, disturbance: Disturbance) -> None:
        """Let something happen between two ticks; DisturbanceRefused if it is not possible."""
        ...

    @property
    def acts(self) -> bool:
        """Whether a disturbance is not over."""
        ...
