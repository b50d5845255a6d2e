"""The specification of fixtures: objects in a cell with their own models."""

from __future__ import annotations

from math import inf
from pathlib import Path

import msgspec

from skillc_runtime.backends.simulation.friction import has_friction_range, read_friction_range
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.data_sheet import DataSheet, number_of, range_below, sheet_of
from skillc_runtime.world.state.terms import (
    BUTTON,
    DEPTH_RANGE,
    FIXTURE,
    PLACE_RANGE,
    STIFFNESS_RANGE,
    SWITCH_RANGE,
    SWITCH_TRAVEL,
    TILT_RANGE,
)
from skillc_runtime.world.state.world_state import WorldState


class FixtureSpec(msgspec.Struct, frozen=True):
    """A fixture at its assumed pose in the world, its model and its sheet.

    The true pose may differ by `place_range_m` across its z and `depth_range_m` along it, and be tilted by
    `tilt_range_rad` about its x and y. friction: least and greatest, None for that of the model. stiffness_range: share
    by which springs may differ. A button switches when its cap is pressed in by `switch_travel_m`, up to
    `switch_range_m` more or less; other fixtures have None.
    """

    individual: str
    pose: Pose
    model: Path
    sheet: DataSheet
    place_range_m: float = 0.0
    depth_range_m: float = 0.0
    tilt_range_rad: float = 0.0
    friction: tuple[float, float] | None = None
    stiffness_range: float = 0.0
    switch_travel_m: float | None = None
    switch_range_m: float = 0.0


def read_fixtures(state: WorldState) -> tuple[FixtureSpec, ...]:
    """Read all fixtures in order of IRI; SheetError or FrameError if a fact is missing."""
    return tuple(_fixture(state, each) for each in sorted(state.instances(FIXTURE)))


def _fixture(state: WorldState, fixture: str) -> FixtureSpec:
    sheet = sheet_of(state, fixture)
    travel = number_of(state, sheet.individual, SWITCH_TRAVEL) if state.is_a(fixture, BUTTON) else None

    def within(range_of: str) -> float:
        return number_of(state, fixture, range_of, default=0.0)

    return FixtureSpec(
        individual=fixture,
        pose=pose(state, fixture),
        model=sheet.model,
        sheet=sheet,
        place_range_m=within(PLACE_RANGE),
        depth_range_m=within(DEPTH_RANGE),
        tilt_range_rad=within(TILT_RANGE),
        friction=read_friction_range(state, fixture) if has_friction_range(state, fixture) else None,
        stiffness_range=within(STIFFNESS_RANGE),
        switch_travel_m=travel,
        switch_range_m=range_below(state, fixture, SWITCH_RANGE, inf if travel is None else travel),
    )
