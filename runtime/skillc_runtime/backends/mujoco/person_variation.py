"""What a person really does: where they lead the tool, how hard they pull."""

from __future__ import annotations

from dataclasses import dataclass

from skillc_runtime.backends.mujoco.person_spec import PersonSpec
from skillc_runtime.backends.mujoco.rng import rng_for


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
