"""What the simulation needs to know of people who lead tools by the hand."""

from __future__ import annotations

from dataclasses import dataclass

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
