"""Arranges the steps of a plan in series and in parallel, by the order that their effects and devices require."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TypeAlias

import msgspec

from skillc_model.conditions import Condition
from skillc_model.pddl.devices import locked_parameters
from skillc_model.read_write import ReadWriteSet, facts_read
from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.foresight import foresee
from skillc_runtime.planning.plan import Plan, Step
from skillc_runtime.planning.validation import compute_effects, follow_plan
from skillc_runtime.planning.world_changes import find_changed_facts, find_settled_facts
from skillc_runtime.world.state.world_state import WorldState


class InSeries(msgspec.Struct, frozen=True):
    """Parts that run one after the other."""

    parts: tuple[Arrangement, ...]


class InParallel(msgspec.Struct, frozen=True):
    """Parts that run at the same time."""

    parts: tuple[Arrangement, ...]


Arrangement: TypeAlias = "int | InSeries | InParallel"
"""A series-parallel order of steps, which are given by their index in the plan."""


def arrange_plan(plan: Plan, library: SkillLibrary, state: WorldState) -> Arrangement:
    """Return the plan with steps in parallel wherever their effects and the devices they use allow it.

    A step waits for an earlier one that changes what it reads, reads what it changes, settles the same facts or locks
    the same device: a partial order in which every sequence of the steps has the same effect (Bäckström 1998, block
    deordering without blocks). Steps that the plan keeps apart are in series, too. PlanError if the plan does not work
    from `state`.
    """
    library, state = foresee(library, state)
    return arrange_followed(plan, library, follow_plan(plan, library, state))


def arrange_followed(plan: Plan, library: SkillLibrary, worlds: Sequence[WorldState]) -> Arrangement:
    """Return what `arrange_plan` does of a plan that leads through these worlds, as of `follow_plan`."""
    predecessors = _find_predecessors(plan, library, worlds)
    return arrange_partial_order(range(len(predecessors)), lambda one, other: one in predecessors[other])


def find_predecessors(plan: Plan, library: SkillLibrary, state: WorldState) -> tuple[frozenset[int], ...]:
    """Return for each step the earlier ones that must end first; PlanError if the plan does not work from `state`."""
    library, state = foresee(library, state)
    return _find_predecessors(plan, library, follow_plan(plan, library, state))


def _find_predecessors(plan: Plan, library: SkillLibrary, worlds: Sequence[WorldState]) -> tuple[frozenset[int], ...]:
    locked = locked_parameters(library)
    sets = [
        read_write_set(step, library, locked, before, after)
        for step, before, after in zip(plan.steps, worlds, worlds[1:], strict=False)
    ]
    predecessors: list[frozenset[int]] = []
    for late in range(len(sets)):
        direct = [each for each in range(late) if (each, late) in plan.apart or sets[each].conflicts(sets[late])]
        predecessors.append(frozenset(direct).union(*(predecessors[each] for each in direct)))
    return tuple(predecessors)


def arrange_partial_order(steps: Sequence[int], before: Callable[[int, int], bool]) -> Arrangement:
    """Return steps with the partial order `before`, composed in series and in parallel.

    An order that is not series-parallel is made stricter: first the steps that wait for none, then the others.
    """
    if len(steps) < 2:
        return steps[0] if steps else InSeries(())
    parallel = _connected_components(steps, lambda one, other: before(one, other) or before(other, one))
    if len(parallel) > 1:
        return InParallel(tuple(arrange_partial_order(part, before) for part in parallel))
    in_order = _connected_components(steps, lambda one, other: not before(one, other) and not before(other, one))
    if len(in_order) == 1:
        first = [each for each in steps if not any(before(other, each) for other in steps)]
        in_order = [first, [each for each in steps if each not in first]]
    return _flatten(InSeries(tuple(arrange_partial_order(part, before) for part in in_order)))


def step_numbers(arrangement: Arrangement) -> tuple[int, ...]:
    """Return the steps in the order of the arrangement."""
    if isinstance(arrangement, int):
        return (arrangement,)
    return tuple(number for part in arrangement.parts for number in step_numbers(part))


def _flatten(series: InSeries) -> InSeries:
    parts: list[Arrangement] = []
    for part in series.parts:
        parts.extend(part.parts if isinstance(part, InSeries) else (part,))
    return InSeries(tuple(parts))


def _connected_components(steps: Iterable[int], linked: Callable[[int, int], bool]) -> list[list[int]]:
    """Return the connected components of a graph of steps, each sorted, ordered by their first steps."""
    groups: list[list[int]] = []
    for step in steps:
        meeting = [group for group in groups if any(linked(step, other) for other in group)]
        merged = sorted([step, *(each for group in meeting for each in group)])
        groups = [group for group in groups if group not in meeting] + [merged]
    return sorted(groups)


def read_write_set(
    step: Step, library: SkillLibrary, locked: Mapping[str, tuple[str, ...]], before: WorldState, after: WorldState
) -> ReadWriteSet:
    """Return what a step reads and writes between two versions of the world; `locked`: device parameters by skill."""
    vocabulary = before.vocabulary
    reads = (fact for each in _conditions(step, library) for fact in facts_read(each, step.arguments, vocabulary))
    settles = (fact for each in compute_effects(step, library, before) for fact in find_settled_facts(each, before))
    return ReadWriteSet(
        reads=frozenset(reads),
        writes=frozenset(find_changed_facts(before, after)),
        settles=frozenset(settles),
        devices=frozenset(step.arguments[name] for name in locked[step.skill] if name in step.arguments),
    )


def _conditions(step: Step, library: SkillLibrary) -> Iterator[Condition]:
    """Yield the preconditions and hold conditions of a step's skill and of all its implementations."""
    skill = library.skills[step.skill]
    alternatives = ((each.pre, each.hold) for each in library.implementations_of(skill.name))
    for requirements in ((skill.pre, skill.hold), *alternatives):
        yield from (requirement.condition for group in requirements for requirement in group)
