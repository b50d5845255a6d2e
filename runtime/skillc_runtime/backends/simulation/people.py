"""People who guide tools by hand: their specification, and how they differ from it in a run."""

from __future__ import annotations

import msgspec

from skillc_runtime.devices.rng import rng_for
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.data_sheet import number_of, range_below
from skillc_runtime.world.state.terms import LEAD_RANGE, LEADS, PERSON, STRENGTH, STRENGTH_RANGE
from skillc_runtime.world.state.world_state import WorldState


class PersonSpec(msgspec.Struct, frozen=True):
    """A person: the arm they guide, the goal of its tool in the world (3,) m, and their greatest force in N.

    The true goal may differ by `range_m` along each axis, the force by `strength_range_n`.
    """

    individual: str
    arm: str
    place: Array
    range_m: float
    strength_n: float
    strength_range_n: float


def read_people(state: WorldState) -> tuple[PersonSpec, ...]:
    """Read all people in order of IRI; SheetError or FrameError if a fact is missing."""
    return tuple(
        PersonSpec(
            individual=each,
            arm=arm,
            place=pose(state, each).position,
            range_m=number_of(state, each, LEAD_RANGE, default=0.0),
            strength_n=number_of(state, each, STRENGTH),
            strength_range_n=range_below(state, each, STRENGTH_RANGE, number_of(state, each, STRENGTH)),
        )
        for each in sorted(state.instances(PERSON))
        for arm in sorted(state.objects(each, LEADS))
    )


class PersonVariation(msgspec.Struct, frozen=True):
    """One person: the offset in m of the goal along each world axis, the greatest force in N, and whether present."""

    person: str
    place_m: tuple[float, float, float]
    strength_n: float
    present: bool = True

    @property
    def description(self) -> str:
        """The differences as text."""
        x, y, z = (1e3 * each for each in self.place_m)
        return f"leads {x:+.0f}, {y:+.0f} and {z:+.0f} mm beside, with {self.strength_n:.0f} N at most"


def draw_person(person: PersonSpec, seed: int) -> PersonVariation:
    """Draw the differences, uniformly within the ranges of the facts."""
    rng = rng_for(person.individual, seed)
    x, y, z = (person.range_m * rng.uniform(-1.0, 1.0, 3)).tolist()
    strength = person.strength_n + person.strength_range_n * float(rng.uniform(-1.0, 1.0))
    return PersonVariation(person.individual, (x, y, z), strength)
