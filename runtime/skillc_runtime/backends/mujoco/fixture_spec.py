"""What the simulation needs to know of fixtures: what stands in a cell with a model of its own."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from pathlib import Path

from skillc_runtime.backends.mujoco.friction import has_friction_range, read_friction_range
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


@dataclass(frozen=True, slots=True)
class FixtureSpec:
    """A fixture where it is believed to be in the world, its model and its sheet.

    It may really stand `place_range_m` beside that, across its z, and `depth_range_m` before or behind it, along z,
    tilted by `tilt_range_rad` about its x and y, with a sliding friction between the two of `friction`, None for that
    of its model, and springs that are stiffer or softer by the share `stiffness_range`.
    A button switches when its cap is `switch_travel_m` in, `switch_range_m` more or less; other fixtures have None.
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
    """Read all fixtures in order of IRI; SheetError or FrameError name the fact that is missing."""
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
