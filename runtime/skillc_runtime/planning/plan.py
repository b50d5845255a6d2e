"""Plans, and what planners answer."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol, TypeAlias

from skillc_compiler.library.pddl.problem import Problem


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


@dataclass(frozen=True, slots=True)
class Solved:
    """A plan; `proven` when no plan is shorter. `planner` is who found it."""

    plan: Plan
    optimal: Literal["proven", "best found"]
    planner: str


@dataclass(frozen=True, slots=True)
class Unsolvable:
    """Proof that there is no plan, and why in words, as far as it could be found out."""

    why: str


@dataclass(frozen=True, slots=True)
class GaveUp:
    """No answer: out of time or memory, or the planner failed; with the reason."""

    why: str


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
