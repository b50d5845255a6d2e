"""Plans, what planners answer, and what is claimed of a plan."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import Literal, Protocol, TypeAlias, assert_never

from skillc_model.pddl.problem import Problem


@dataclass(frozen=True, slots=True)
class Step:
    """A skill with the individuals (IRIs) of the parameters that the planner bound."""

    skill: str
    arguments: dict[str, str]


@dataclass(frozen=True, slots=True)
class Plan:
    """Steps in order, and their expected duration in seconds."""

    steps: tuple[Step, ...]
    duration_s: float


Optimal: TypeAlias = Literal[
    "proven", "optimal for the filtered problem", "optimal for approximate durations", "best found"
]

Kind: TypeAlias = Literal["individuals", "skills", "steps"]


@dataclass(frozen=True, slots=True)
class LeftOut:
    """Individuals (IRIs), skills or steps, in any order, that a problem leaves out for one reason.

    `harmless` says that it is proved: with them no plan would be cheaper, and there would be none if there is none.
    """

    members: Collection[str]
    why: str
    harmless: bool
    kind: Kind = "individuals"

    @property
    def what(self) -> tuple[str, ...]:
        """Return them sorted: there may be a million, and most answers show none."""
        return tuple(sorted(self.members))


@dataclass(frozen=True, slots=True)
class Solved:
    """A plan; `proven` when no plan of the whole problem is shorter. `planner` is who found it.

    It was found without what is `left_out` of the scene and the library. A shorter one than one that is `optimal for
    the filtered problem` would have to need something of that. `optimal for approximate durations` is a plan of which
    that is proved for durations that were rounded down to units that planners take, or estimated as the `assumptions`
    say. Any plan takes `at_least_s`, where that is known and less than proven.
    """

    plan: Plan
    optimal: Optimal
    planner: str
    left_out: tuple[LeftOut, ...] = ()
    at_least_s: float | None = None
    assumptions: tuple[str, ...] = ()

    @property
    def bound_s(self) -> float:
        """A time in seconds that every plan takes."""
        return self.plan.duration_s if self.optimal == "proven" else self.at_least_s or 0.0


@dataclass(frozen=True, slots=True)
class Unsolvable:
    """Proof that the whole problem has no plan, and why in words, as far as it could be found out."""

    why: str

    @property
    def message(self) -> str:
        """The answer as a sentence."""
        return f"there is no plan: {self.why}"


@dataclass(frozen=True, slots=True)
class GaveUp:
    """No answer, with the reason: out of time or memory, or the planner failed.

    Nothing was `searched` where the goal cannot be given to a planner. That says nothing about the world.
    """

    why: str
    searched: bool = True

    @property
    def message(self) -> str:
        """The answer as a sentence."""
        return f"no plan was {'found' if self.searched else 'looked for'}: {self.why}"


PlanResult: TypeAlias = Solved | Unsolvable | GaveUp


class Planner(Protocol):
    """Something that solves planning problems."""

    @property
    def name(self) -> str:
        """What users know it by."""
        ...

    def plan(self, problem: Problem, deadline_s: float) -> PlanResult:
        """Solve a problem within so many seconds of wall-clock time; never raises for what the problem or time is."""
        ...


PARTS: dict[Kind, str] = {
    "individuals": "the part of the scene that was planned with",
    "skills": "the skills that can be planned with",
    "steps": "the steps that have not failed",
}


def describe_quality(optimal: Optimal, left_out: Collection[LeftOut], at_least_s: float | None) -> str:
    """Say how good a plan is known to be, and for what: `proved optimal` refers to the whole problem."""
    known = "" if at_least_s is None else f", any plan takes at least {at_least_s:g} s"
    missing = {each.kind for each in left_out if not each.harmless}
    parts = [words for kind, words in PARTS.items() if kind in missing]
    match optimal:
        case "proven":
            return "proved optimal"
        case "optimal for the filtered problem":
            return f"optimal for {' and '.join(parts)}{known}"
        case "optimal for approximate durations":
            return f"optimal for {' and '.join([*parts, 'approximate durations'])}{known}"
        case "best found":
            return f"best found, not proved optimal{known}"
        case _:
            assert_never(optimal)
