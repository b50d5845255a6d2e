"""What the simulation needs to know of people who lead tools by the hand."""

from __future__ import annotations

from dataclasses import dataclass

from skillc_runtime.backends.mujoco.rng import rng_for
from skillc_runtime.motion.pose import Array
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.data_sheet import number_of, range_below
from skillc_runtime.world.state.terms import LEAD_RANGE, LEADS, PERSON, STRENGTH, STRENGTH_RANGE
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class PersonSpec:
    """A person: the arm they lead, where they want its tool in the world (3,) m, and how hard they pull at most in N.

    The place may really be `range_m` beside that along each axis, the strength `strength_range_n` more or less.
    """

    individual: str
    arm: str
    place: Array
    range_m: float
    strength_n: float
    strength_range_n: float


def read_people(state: WorldState) -> tuple[PersonSpec, ...]:
    """Read all people in order of IRI; SheetError or FrameError name the fact that is missing."""
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


@dataclass(frozen=True, slots=True)
class PersonVariation:
    """One person: m beside the believed place along each axis of the world, N at most; or not `present` at all."""

    person: str
    place_m: tuple[float, float, float]
    strength_n: float
    present: bool = True

    @property
    def description(self) -> str:
        """What differs, in words."""
        x, y, z = (1e3 * each for each in self.place_m)
        return f"leads {x:+.0f}, {y:+.0f} and {z:+.0f} mm beside, with {self.strength_n:.0f} N at most"


def draw_person(person: PersonSpec, seed: int) -> PersonVariation:
    """Draw the differences, evenly within the ranges of the facts."""
    rng = rng_for(person.individual, seed)
    x, y, z = (person.range_m * rng.uniform(-1.0, 1.0, 3)).tolist()
    strength = person.strength_n + person.strength_range_n * float(rng.uniform(-1.0, 1.0))
    return PersonVariation(person.individual, (x, y, z), strength)
