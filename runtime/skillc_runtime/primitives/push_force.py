"""Writes with which force an arm pushed; that is sensed if the force was measured, by a signal that was checked."""

from __future__ import annotations

from skillc_runtime.devices.guarded_push import MeasuredForce
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.data_sheet import SheetError, number_of, sheet_of
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import FORCE_TOLERANCE, PUSH_FORCE
from skillc_runtime.world.state.world_state import WorldState

TOLERANCE = 0.05
"""The share of a commanded force by which the measured one may differ, unless the arm's sheet states it."""


def write_push_force(world: WorldModel, arm: str, wanted_n: float, measured: MeasuredForce) -> None:
    """Write that an arm pushed with the commanded force, and why that is only assumed, if it is."""
    doubt = find_doubt(wanted_n, measured, _tolerance(world.snapshot(), arm))
    change = SetProperty(arm, PUSH_FORCE, wanted_n)
    if doubt is None:
        world.commit([change], "Push", "sensed")
    else:
        world.commit([change], f"Push: {doubt}", "assumed")


def find_doubt(wanted_n: float, measured: MeasuredForce, tolerance: float) -> str | None:
    """Return why a measurement does not confirm a force, a sentence; None if it does, within the tolerance, a share.

    What is measured before contact is an error of the signal: it is subtracted, and must be small itself.
    """
    if measured.pressed_n is None:
        return "the arm has nothing that measures its force, or pressed too briefly"
    if measured.free_n is None:
        return (
            f"the arm measured {measured.pressed_n:.2f} N for {wanted_n:g} N, but did not approach steadily for "
            "long enough to check that it measures 0 N when it touches nothing"
        )
    exerted_n, band_n = measured.pressed_n - measured.free_n, tolerance * wanted_n
    if abs(measured.free_n) > band_n:
        return (
            f"the arm measured {measured.free_n:.2f} N when it touched nothing; less this error it pressed with "
            f"{exerted_n:.2f} N for {wanted_n:g} N"
        )
    if abs(exerted_n - wanted_n) > band_n:
        return f"the arm measured {exerted_n:.2f} N for {wanted_n:g} N, which may differ by {tolerance:.0%}"
    return None


def _tolerance(state: WorldState, arm: str) -> float:
    try:
        return number_of(state, sheet_of(state, arm).individual, FORCE_TOLERANCE, default=TOLERANCE)
    except SheetError:
        return TOLERANCE
