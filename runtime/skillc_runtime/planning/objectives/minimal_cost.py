"""Plans whose steps cost little in all, by the `cost` of their skills."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import lru_cache

from msgspec.structs import replace

from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.foresight import foresee
from skillc_runtime.planning.plan import Branch, LeftOut, Plan, PlanResult, Solved
from skillc_runtime.planning.stated_facts import LibraryKey
from skillc_runtime.planning.validation import apply_step, compute_step_duration_s
from skillc_runtime.world.state.world_state import WorldState


def minimise_cost(library: SkillLibrary, state: WorldState, search: Callable[[SkillLibrary], PlanResult]) -> PlanResult:
    """Return the answer of a search for a plan with little work, in a library whose skills take 1 s for a cost of 1.

    A skill that states no cost has the cost 1. The plan has the durations of the given library.
    """
    answer = search(_with_costs(LibraryKey(library)))
    if not isinstance(answer, Solved):
        return answer
    return replace(
        answer,
        plan=_with_durations(answer.plan, *foresee(library, state)),
        cost=answer.plan.duration_s,
        left_out=tuple(_name_cost(each) for each in answer.left_out),
        assumptions=tuple(each.replace("duration of ", "cost of ", 1) for each in answer.assumptions),
    )


@lru_cache(maxsize=4)
def _with_costs(key: LibraryKey) -> SkillLibrary:
    library = key.library
    return replace(
        library,
        skills={name: replace(each, duration=each.cost) for name, each in library.skills.items()},
        implementations={name: replace(each, duration=None) for name, each in library.implementations.items()},
    )


def _name_cost(left_out: LeftOut) -> LeftOut:
    return replace(left_out, why=left_out.why.replace("its duration ", "its cost "))


def _with_durations(plan: Plan, library: SkillLibrary, state: WorldState) -> Plan:
    """Return a plan with the expected durations of its steps and branches."""
    before, work = state, Fraction(0)
    for number, step in enumerate(plan.steps, 1):
        work += compute_step_duration_s(step, library, state, before)
        if number < len(plan.steps) or not plan.branches:
            state = apply_step(step, library, state)
    branches = tuple(_time_branch(each, plan, library, state) for each in plan.branches)
    planned = [(each.likely, each.plan.duration_s) for each in branches if each.plan is not None]
    share = sum(likely for likely, _ in planned) or 1.0
    mean_s = sum(likely * seconds for likely, seconds in planned) / share
    return replace(plan, duration_s=float(work) + mean_s, branches=branches)


def _time_branch(branch: Branch, plan: Plan, library: SkillLibrary, state: WorldState) -> Branch:
    if branch.plan is None:
        return branch
    after = apply_step(plan.steps[-1].with_outcome(branch.outcome), library, state)
    return replace(branch, plan=_with_durations(branch.plan, library, after))
