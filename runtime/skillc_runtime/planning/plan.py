"""Plans, the answers of planners, and how good a plan is known to be."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from itertools import combinations
from typing import Literal, Protocol, TypeAlias, assert_never

import msgspec

from skillc_model.conditions import And, Condition
from skillc_model.pddl.problem import Problem
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.planning.progress import ReportProgress, ignore_progress


class Step(msgspec.Struct, frozen=True):
    """A skill with the individuals (IRIs) that the planner bound to its parameters.

    `outcome` is the label of what comes of it; empty if the skill has no outcomes, or if branches of the plan follow.
    """

    skill: str
    arguments: dict[str, str]
    outcome: str = ""

    def with_outcome(self, outcome: str) -> Step:
        """Return the step of which this outcome comes."""
        return msgspec.structs.replace(self, outcome=outcome)


class StepWhile(msgspec.Struct, frozen=True):
    """A step that does not go as long as a ground condition holds, and why.

    And only as long as no step before has put the things `unmoved` elsewhere, and one has each of the things `moved`.
    """

    step: Step
    condition: Condition
    why: str
    unmoved: tuple[str, ...] = ()
    moved: tuple[str, ...] = ()

    @property
    def always(self) -> bool:
        """Whether the step never goes."""
        return self.condition == And(()) and not self.unmoved and not self.moved


Excluded: TypeAlias = Step | StepWhile
"""What a plan may not contain."""


class Branch(msgspec.Struct, frozen=True):
    """How a policy goes on after an outcome of its last step, and how likely that outcome is there, from 0 to 1.

    Without a plan it is planned when the outcome comes.
    """

    outcome: str
    likely: float
    plan: Plan | None


class Plan(msgspec.Struct, frozen=True):
    """Steps in order, and their expected duration in seconds.

    `apart` are pairs of steps, by index, the earlier one first, that may not run at the same time, whatever the facts
    say. A policy goes on with one of its `branches`, by what comes of the last step: its duration is that of its steps
    and the mean of its branches, weighted by how likely they are, and `worst_s` with the longest branch instead. Both
    leave out branches that are not planned yet.
    """

    steps: tuple[Step, ...]
    duration_s: float
    apart: frozenset[tuple[int, int]] = frozenset()
    branches: tuple[Branch, ...] = ()

    @property
    def worst_s(self) -> float:
        """Its duration in s if always the longest branch comes."""
        planned = [(each.likely, each.plan) for each in self.branches if each.plan is not None]
        share = sum(likely for likely, _ in planned) or 1.0
        mean_s = sum(likely * plan.duration_s for likely, plan in planned) / share
        return self.duration_s - mean_s + max((plan.worst_s for _, plan in planned), default=0.0)

    @property
    def count(self) -> int:
        """The number of steps, those of all branches included."""
        return len(self.steps) + sum(each.plan.count for each in self.branches if each.plan is not None)

    def list_open(self) -> Iterator[tuple[Step, ...]]:
        """Yield the looks, each with its outcome, that lead to each branch which is not planned yet."""
        for branch in self.branches:
            look = self.steps[-1].with_outcome(branch.outcome)
            yield from ((look,),) if branch.plan is None else ((look, *more) for more in branch.plan.list_open())

    def find_branch(self, outcome: str) -> Plan | None:
        """Return how it goes on after an outcome; None if that is not planned."""
        return next((each.plan for each in self.branches if each.outcome == outcome), None)

    def keep(self, steps: Iterable[Step]) -> Plan:
        """Return a plan of some of these steps, in any order, of which the same may not run at the same time."""
        left, kept = list(enumerate(self.steps)), list[tuple[int, Step]]()
        for step in steps:
            place = next(each for each in left if each[1] == step)
            left.remove(place)
            kept.append(place)
        pairs = combinations(range(len(kept)), 2)
        apart = (pair for pair in pairs if tuple(sorted(kept[each][0] for each in pair)) in self.apart)
        looks = bool(kept) and kept[-1][0] == len(self.steps) - 1
        branches = self.branches if looks else ()
        return Plan(tuple(step for _, step in kept), self.duration_s, frozenset(apart), branches)


Optimal: TypeAlias = Literal[
    "proven", "optimal for the filtered problem", "optimal for approximate durations", "best found"
]

Kind: TypeAlias = Literal["individuals", "skills", "steps", "chains", "numbers"]


class LeftOut(msgspec.Struct, frozen=True):
    """Individuals (IRIs), skills, steps or chains of facts, in any order, that a problem leaves out for one reason.

    `harmless` if it is proved that leaving them out changes neither whether there is a plan nor the least cost.
    """

    members: Collection[str]
    why: str
    harmless: bool
    kind: Kind = "individuals"

    @property
    def what(self) -> tuple[str, ...]:
        """The members, sorted on demand: there may be a million, and most answers show none."""
        return tuple(sorted(self.members))


class Solved(msgspec.Struct, frozen=True):
    """A plan, the name of the planner that found it, and what was `left_out` of the scene and the library.

    `optimal` is "proven" if no plan of the whole problem is shorter, and "optimal for the filtered problem" if a
    shorter plan would need something that was left out. With "optimal for approximate durations" the proof holds for
    durations that were rounded down to the planner's units, or estimated as `assumptions` describes. `at_least_s` is
    a lower bound in s on the duration of any plan; None if none is known or the plan is proven to be optimal. If what
    its steps `cost` was minimised, that is what is said of it, `at_least_s` included.
    """

    plan: Plan
    optimal: Optimal
    planner: str
    left_out: tuple[LeftOut, ...] = ()
    at_least_s: float | None = None
    assumptions: tuple[str, ...] = ()
    cost: float | None = None

    @property
    def bound_s(self) -> float:
        """A lower bound on the duration of any plan, in s."""
        return self.plan.duration_s if self.optimal == "proven" else self.at_least_s or 0.0


class Unsolvable(msgspec.Struct, frozen=True):
    """The whole problem is proved to have no plan; `why` is an explanation, as far as one could be found.

    `causes` are what the cell lacks, or cannot do, at the end of this explanation.
    """

    why: str
    causes: tuple[str, ...] = ()

    @property
    def message(self) -> str:
        """The answer as a sentence."""
        return f"there is no plan: {'; '.join(self.causes) or self.why}"


class GaveUp(msgspec.Struct, frozen=True):
    """No answer, with the reason: out of time or memory, or the planner failed.

    `searched` is False if the goal cannot be expressed for a planner. `causes` are as of `Unsolvable`. If it is proved
    that each plan needs something that was left out, `needed` is what was.
    """

    why: str
    searched: bool = True
    causes: tuple[str, ...] = ()
    needed: tuple[LeftOut, ...] = ()

    @property
    def message(self) -> str:
        """The answer as a sentence."""
        why = "; ".join(self.causes) or self.why
        return f"no plan was {'found' if self.searched else 'searched for'}: {why}"


PlanResult: TypeAlias = Solved | Unsolvable | GaveUp


class Planner(Protocol):
    """Solves planning problems; the cost of a plan is the sum of its durations."""

    @property
    def name(self) -> str:
        """The name that is shown to users."""
        ...

    def plan(self, problem: Problem, cancel: CancelToken, report: ReportProgress = ignore_progress) -> PlanResult:
        """Solve a problem before `cancel` ends the search, and `report` how far it is while that goes on.

        All failures are answers, not exceptions.
        """
        ...


PARTS: dict[Kind, str] = {
    "individuals": "the part of the scene that was planned with",
    "skills": "the skills that can be planned with",
    "steps": "the steps that have not failed",
    "chains": "what follows from a few facts that skills change",
    "numbers": "the values that few changes give to numbers",
}


def describe_quality(
    optimal: Optimal, left_out: Collection[LeftOut], at_least_s: float | None, costs: bool = False
) -> str:
    """Describe how good a plan is known to be; "proved optimal" refers to the whole problem.

    The lower bound is one of costs, not of seconds, if it `costs`.
    """
    least = (
        "" if at_least_s is None else f"costs {at_least_s:g} or more" if costs else f"takes at least {at_least_s:g} s"
    )
    known = least and f", any plan {least}"
    missing = {each.kind for each in left_out if not each.harmless}
    parts = [words for kind, words in PARTS.items() if kind in missing]
    match optimal:
        case "proven":
            return "proved optimal"
        case "optimal for the filtered problem":
            return f"optimal for {' and '.join(parts)}{known}"
        case "optimal for approximate durations":
            approximate = f"approximate {'costs' if costs else 'durations'}"
            return f"optimal for {' and '.join([*parts, approximate])}{known}"
        case "best found":
            return f"best found, not proved optimal{known}"
        case _:
            assert_never(optimal)
