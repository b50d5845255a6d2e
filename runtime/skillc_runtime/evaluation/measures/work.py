"""What is measured of one piece of work in a trial: a type of result for each kind of work."""

from __future__ import annotations

from typing import TypeAlias

import msgspec

from skillc_runtime.evaluation.report.result import WipingResult
from skillc_runtime.world.state.labels.labelled import LabelledIri


class WipingWork(msgspec.Struct, frozen=True, kw_only=True, tag="wiping"):
    """A surface was wiped."""

    wiping: WipingResult


class PolishingWork(msgspec.Struct, frozen=True, kw_only=True, tag="polishing"):
    """A surface was polished: wiped with an oscillating overlay, whose measured and commanded amplitudes are in m.

    The amplitudes are None without an overlay. `polished_share` of the surface was rubbed for the required time.
    """

    wiping: WipingResult
    polished_share: float
    overlay_amplitude_m: float | None
    commanded_amplitude_m: float | None


class PressingWork(msgspec.Struct, frozen=True, kw_only=True, tag="pressing"):
    """A button was pressed: forces in N that it requires, that held it after it had switched, and the greatest one.

    `duration_share` is the time of the work relative to the duration of the skill; None if the skill declares none.
    """

    button: LabelledIri
    required_n: float
    held_n: float
    greatest_n: float
    duration_share: float | None


class InsertingWork(msgspec.Struct, frozen=True, kw_only=True, tag="inserting"):
    """A peg is in a socket: its depth and the depth of the hole in m, the greatest force on it in N."""

    socket: LabelledIri
    depth_m: float
    hole_depth_m: float
    greatest_n: float
    duration_share: float | None


class TeachingWork(msgspec.Struct, frozen=True, kw_only=True, tag="teaching"):
    """A pose was taught: its distance in m from the intended one, the greatest and mean force of the person in N."""

    pose: LabelledIri
    position_error_m: float
    greatest_n: float
    mean_n: float
    duration_share: float | None


class PlacingWork(msgspec.Struct, frozen=True, kw_only=True, tag="placing"):
    """A thing was put down: how far it is from its believed pose, in m and degrees, and from the intended place, in m.

    `missed_m` is None if no place was intended.
    """

    thing: LabelledIri
    error_m: float
    turned_deg: float
    missed_m: float | None


Work: TypeAlias = WipingWork | PolishingWork | PressingWork | InsertingWork | TeachingWork | PlacingWork
