"""How a fixture differs from its specification: pose, friction, stiffness, switching, and whether it is blocked."""

from __future__ import annotations

import msgspec
import numpy as np

from skillc_runtime.backends.simulation.fixture_spec import FixtureSpec
from skillc_runtime.backends.simulation.signed import format_signed, format_tilt
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.pose import Pose, exp


class FixtureVariation(msgspec.Struct, frozen=True):
    """One fixture: the offset in m from its assumed pose along its axes, the tilt in rad about its x and y.

    friction: sliding, None for that of the model; stiffness_share: how much stiffer its springs are; switch_m: how much
    later a button switches; present: false if it is absent; blocked: true if something is in the way.
    """

    fixture: str
    place_m: tuple[float, float, float]
    tilt_rad: tuple[float, float]
    friction: float | None
    stiffness_share: float
    switch_m: float
    present: bool = True
    blocked: bool = False

    def true_pose(self, believed: Pose) -> Pose:
        """Return the true pose of the fixture, in the frame of the assumed one."""
        return believed @ Pose(np.array(self.place_m), exp(np.array([*self.tilt_rad, 0.0])))

    @property
    def description(self) -> str:
        """The differences as text."""
        x, y, z = (1e3 * each for each in self.place_m)
        tilt = format_tilt(*np.degrees(self.tilt_rad).tolist())
        friction = "" if self.friction is None else f", friction {self.friction:.2f}"
        spring = f", springs {format_signed(100 * self.stiffness_share, 0)} %" if self.stiffness_share else ""
        switch = f", switching {format_signed(1e3 * self.switch_m, 1)} mm later" if self.switch_m else ""
        place = f"{np.hypot(x, y):.1f} mm beside and {format_signed(z, 1)} mm along its axis"
        return f"{place}{tilt}{friction}{spring}{switch}"


def draw_fixture(fixture: FixtureSpec, seed: int) -> FixtureVariation:
    """Draw the differences uniformly: the position on a disc across the axis and along it, the rest within ranges."""
    rng = rng_for(fixture.individual, seed)
    away = fixture.place_range_m * float(np.sqrt(rng.uniform()))
    towards, along = float(rng.uniform(0.0, 2 * np.pi)), float(rng.uniform(-1.0, 1.0))
    tilt_x, tilt_y, stiffness, switch = rng.uniform(-1.0, 1.0, 4).tolist()
    rubbing = float(rng.uniform())
    return FixtureVariation(
        fixture=fixture.individual,
        place_m=(away * float(np.cos(towards)), away * float(np.sin(towards)), along * fixture.depth_range_m),
        tilt_rad=(tilt_x * fixture.tilt_range_rad, tilt_y * fixture.tilt_range_rad),
        friction=None if fixture.friction is None else _between(*fixture.friction, rubbing),
        stiffness_share=stiffness * fixture.stiffness_range,
        switch_m=switch * fixture.switch_range_m,
    )


def exact_fixture(fixture: FixtureSpec) -> FixtureVariation:
    """Return no differences, with mean friction."""
    friction = None if fixture.friction is None else sum(fixture.friction) / 2
    return FixtureVariation(fixture.individual, (0.0, 0.0, 0.0), (0.0, 0.0), friction, 0.0, 0.0)


def _between(low: float, high: float, share: float) -> float:
    return low + (high - low) * share
