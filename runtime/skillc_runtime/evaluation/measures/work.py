"""What is measured of one piece of work in a trial: a kind of result for each kind of thing that is worked on."""

from __future__ import annotations

from typing import TypeAlias

import msgspec

from skillc_runtime.evaluation.report.result import WipingResult


class WipingWork(msgspec.Struct, frozen=True, kw_only=True, tag="wiping"):
    """A surface was wiped."""

    how: WipingResult


class PolishingWork(msgspec.Struct, frozen=True, kw_only=True, tag="polishing"):
    """A surface was polished, which is wiping with a swing: how far it went, and was asked to, m; None without one.

    `share` of the surface was rubbed for as long as the scene wants.
    """

    how: WipingResult
    share: float
    swing_m: float | None
    swing_asked_m: float | None


class PressingWork(msgspec.Struct, frozen=True, kw_only=True, tag="pressing"):
    """A button was pressed: N that it wants, that it was held with once it had switched, and that it ever felt.

    `took` is the time it took, as a share of what the skill says, for this and all other work; None where it says none.
    """

    button: str
    asked_n: float
    held_n: float
    greatest_n: float
    took: float | None


class InsertingWork(msgspec.Struct, frozen=True, kw_only=True, tag="inserting"):
    """A peg is in a socket: m that it is deep in it and that the hole is deep, N that it was pressed with at most."""

    socket: str
    depth_m: float
    hole_m: float
    greatest_n: float
    took: float | None


class TeachingWork(msgspec.Struct, frozen=True, kw_only=True, tag="teaching"):
    """A pose was taught: m from where the person wanted it, N with which they led the tool, at most and on average."""

    pose: str
    off_m: float
    greatest_n: float
    mean_n: float
    took: float | None


Work: TypeAlias = WipingWork | PolishingWork | PressingWork | InsertingWork | TeachingWork
