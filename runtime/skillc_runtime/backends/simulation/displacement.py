"""How far things really lie from where they are believed to be: ranges in the facts, and what is drawn from them."""

from __future__ import annotations

from math import degrees

import msgspec
import numpy as np

from skillc_runtime.backends.simulation.signed import format_signed
from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.pose import Pose, exp
from skillc_runtime.world.state.data_sheet import number_of
from skillc_runtime.world.state.terms import POSITION_RANGE, PRODUCT, TURN_RANGE
from skillc_runtime.world.state.world_state import WorldState


class DisplacementRange(msgspec.Struct, frozen=True):
    """A thing, and how far it may lie beside its believed place: m along x and y, rad about z, in the world."""

    individual: str
    position_m: float
    turn_rad: float


class Displacement(msgspec.Struct, frozen=True):
    """How far a thing really lies beside its believed place: m along x and y, rad about z, in the world."""

    individual: str
    offset_m: tuple[float, float]
    turn_rad: float

    def true_pose(self, believed: Pose) -> Pose:
        """Return where the thing really is in the world; it is turned about the vertical through its frame."""
        shift = np.array([*self.offset_m, 0.0])
        return Pose(believed.position + shift, exp(np.array([0.0, 0.0, self.turn_rad])) @ believed.rotation)

    @property
    def description(self) -> str:
        """The displacement as text."""
        x, y = (1e3 * each for each in self.offset_m)
        beside = f"lies {format_signed(x, 0)} and {format_signed(y, 0)} mm beside its believed place"
        return f"{beside}, turned {format_signed(degrees(self.turn_rad), 1)} deg"


def read_displacement_ranges(state: WorldState) -> tuple[DisplacementRange, ...]:
    """Read the ranges of all products that state one, in order of IRI."""
    ranges = (
        DisplacementRange(each, *(number_of(state, each, name, default=0.0) for name in (POSITION_RANGE, TURN_RANGE)))
        for each in sorted(state.instances(PRODUCT))
    )
    return tuple(each for each in ranges if each.position_m or each.turn_rad)


def draw_displacement(thing: DisplacementRange, seed: int) -> Displacement:
    """Draw a displacement uniformly within its range."""
    x, y, turn = rng_for(thing.individual, seed, 5).uniform(-1.0, 1.0, 3).tolist()
    return Displacement(thing.individual, (x * thing.position_m, y * thing.position_m), turn * thing.turn_rad)
