"""Plans that keep what a task says holds always."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache

from msgspec.structs import replace

from skillc_model.always import KeptLibrary, keep_always
from skillc_model.conditions import Condition, Individual
from skillc_model.format_condition import format_condition
from skillc_model.skills import SkillLibrary
from skillc_model.traversal import walk
from skillc_runtime.planning.foresight import foresee
from skillc_runtime.planning.plan import GaveUp, Plan, Solved, Unsolvable
from skillc_runtime.planning.schedule import PlanAnswer, Scheduled
from skillc_runtime.planning.stated_facts import LibraryKey
from skillc_runtime.planning.validation import apply_step
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.explain import explain
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

ALONE = "steps that change what `always` reads run beside no other step"


def find_broken(always: Sequence[Condition], state: WorldState) -> str | None:
    """Return what does not hold that is to hold always, and why, as a clause; None if all holds."""
    for each in always:
        text = f"`always {format_condition(each, state.vocabulary)}`"
        try:
            if not evaluate(each, state, {}):
                return f"{text} is broken: {explain(each, state, {}, state.vocabulary)}"
        except EvaluationError as reason:
            return f"{text} cannot be decided: {reason}"
    return None


def find_broken_at_start(always: Sequence[Condition], state: WorldState) -> str | None:
    """Return what does not hold before the first step, or names what there is not, as a clause; None if all holds."""
    named = {each.iri for condition in always for each in walk(condition) if isinstance(each, Individual)}
    unknown = sorted(named - state.individuals)
    if unknown:
        return f"`always` names {state.vocabulary.short(unknown[0])}, which is not in the world model"
    broken = find_broken(always, state)
    return None if broken is None else broken.replace(" is broken: ", " is broken already: ", 1)


def library_that_keeps(library: SkillLibrary, always: tuple[Condition, ...]) -> KeptLibrary:
    """Return a library whose plans keep these conditions; the last ones are cached."""
    return _keep_always(LibraryKey(library), always) if always else KeptLibrary(library)


@lru_cache(maxsize=4)
def _keep_always(key: LibraryKey, always: tuple[Condition, ...]) -> KeptLibrary:
    return keep_always(key.library, always)


def plan_keeping(
    always: tuple[Condition, ...],
    library: SkillLibrary,
    state: WorldState,
    goal: Condition,
    search: Callable[[SkillLibrary, Condition], PlanAnswer],
) -> PlanAnswer:
    """Return the answer of a search for a plan to the goal, in none of whose states a condition of `always` is broken.

    It is checked in each state, whatever the search says. Where there is no such plan, one without the conditions is
    looked for, to say so. If they cannot be expressed for planners, a plan without them is taken if it keeps them.
    """
    if not always:
        return search(library, goal)
    broken = find_broken_at_start(always, state)
    if broken is not None:
        return Unsolvable(broken)
    kept = library_that_keeps(library, always)
    answer = search(kept.library, kept.goal(goal))
    if isinstance(answer, Unsolvable | GaveUp):
        return _look_without(answer, always, library, state, goal, search)
    why = _find_break(answer.plan, *foresee(library, state, goal), always)
    if why is not None:
        return GaveUp(f"{answer.planner} returned a plan that does not work: {why}")
    if kept.alone and isinstance(answer, Scheduled):
        note = ALONE if answer.note is None else f"{answer.note}; {ALONE}"
        return replace(answer, note=note, optimal="best found", at_least_s=None)
    return answer


def _look_without(
    answer: Unsolvable | GaveUp,
    always: tuple[Condition, ...],
    library: SkillLibrary,
    state: WorldState,
    goal: Condition,
    search: Callable[[SkillLibrary, Condition], PlanAnswer],
) -> PlanAnswer:
    """Return an answer with what `always` has to do with it, or a plan that was found without it and keeps it."""
    free = search(library, goal)
    if isinstance(free, Unsolvable | GaveUp):
        return answer
    why = _find_break(free.plan, *foresee(library, state, goal), always)
    if why is None:
        return free if isinstance(free, Solved) else answer
    if isinstance(answer, Unsolvable):
        return Unsolvable(f"each plan breaks what is to hold always; the best plan without it does at {why}")
    if not answer.searched:
        return GaveUp(f"{answer.why}; the best plan without `always` breaks it at {why}")
    return replace(answer, why=f"{answer.why}; the best plan without `always` breaks it at {why}")


def _find_break(plan: Plan, library: SkillLibrary, state: WorldState, always: Sequence[Condition]) -> str | None:
    """Return at which step of a plan, or of one of its branches, what is broken; None if nothing is."""
    before = plan.steps[:-1] if plan.branches else plan.steps
    for number, step in enumerate(before, 1):
        state = apply_step(step, library, state)
        if (broken := find_broken(always, state)) is not None:
            return f"step {number}, {step.skill}: {broken}"
    for branch in plan.branches:
        look = plan.steps[-1].with_outcome(branch.outcome)
        after = apply_step(look, library, state)
        if (broken := find_broken(always, after)) is not None:
            return f"step {len(plan.steps)}, {look.skill}, which ends with `{branch.outcome}`: {broken}"
        found = None if branch.plan is None else _find_break(branch.plan, library, after, always)
        if found is not None:
            return f"{found} (after `{branch.outcome}`)"
    return None
