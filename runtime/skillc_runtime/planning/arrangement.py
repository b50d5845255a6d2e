"""Arranges the steps of a plan in series and in parallel, by the order that their effects and devices require."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import pairwise
from typing import TypeAlias

import msgspec

from skillc_model.conditions import ForEach, bounds_of, single_effect
from skillc_model.pddl.devices import locked_parameters
from skillc_model.read_write import FactPattern, ReadWriteSet, facts_read
from skillc_model.skills import SkillLibrary
from skillc_runtime.planning.deciding_reads import DecidingReads
from skillc_runtime.planning.foresight import foresee
from skillc_runtime.planning.plan import Plan, Step
from skillc_runtime.planning.validation import bind_in, compute_effects, follow_plan
from skillc_runtime.planning.world_changes import find_changed_facts, find_settled_facts
from skillc_runtime.world.state.world_state import WorldState


class InSeries(msgspec.Struct, frozen=True):
    """Parts that run one after the other."""

    parts: tuple[Arrangement, ...]


class InParallel(msgspec.Struct, frozen=True):
    """Parts that run at the same time, each once the earlier ones with the indices in `after` have ended."""

    parts: tuple[Arrangement, ...]
    after: tuple[tuple[int, ...], ...] = ()


Arrangement: TypeAlias = "int | InSeries | InParallel"
"""A partial order of steps, which are given by their index in the plan, in series and in parallel where it can be."""


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
    changes = tuple(pairwise(worlds))
    reads = DecidingReads(fact for each in changes for fact in find_changed_facts(*each))
    sets = [read_write_set(step, library, locked, each, reads) for step, each in zip(plan.steps, changes, strict=True)]
    predecessors: list[frozenset[int]] = []
    for late in range(len(sets)):
        direct = [each for each in range(late) if (each, late) in plan.apart or sets[each].conflicts(sets[late])]
        predecessors.append(frozenset(direct).union(*(predecessors[each] for each in direct)))
    return tuple(predecessors)


def arrange_partial_order(steps: Sequence[int], before: Callable[[int, int], bool]) -> Arrangement:
    """Return steps with the partial order `before`, composed in series and in parallel.

    Steps come after those before them. Where the order is not series-parallel, each waits for those just before it.
    """
    if len(steps) < 2:
        return steps[0] if steps else InSeries(())
    parallel = _connected_components(steps, lambda one, other: before(one, other) or before(other, one))
    if len(parallel) > 1:
        return InParallel(tuple(arrange_partial_order(part, before) for part in parallel))
    in_order = _connected_components(steps, lambda one, other: not before(one, other) and not before(other, one))
    if len(in_order) == 1:
        return InParallel(tuple(steps), tuple(_just_before(each, steps, before) for each in steps))
    return _flatten(InSeries(tuple(arrange_partial_order(part, before) for part in in_order)))


def _just_before(step: int, steps: Sequence[int], before: Callable[[int, int], bool]) -> tuple[int, ...]:
    """Return the indices of the steps before one that are not before others of these."""
    earlier = [(index, each) for index, each in enumerate(steps) if before(each, step)]
    return tuple(index for index, each in earlier if not any(before(each, other) for _, other in earlier))


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
    step: Step,
    library: SkillLibrary,
    locked: Mapping[str, tuple[str, ...]],
    change: tuple[WorldState, WorldState],
    reads: DecidingReads,
) -> ReadWriteSet:
    """Return what a step writes between two versions of the world, and reads of what others write.

    locked: device parameters by skill.
    """
    before, after = change
    settles = (fact for each in compute_effects(step, library, before) for fact in find_settled_facts(each, before))
    return ReadWriteSet(
        reads=frozenset(_find_reads(step, library, before, reads)),
        writes=frozenset(find_changed_facts(before, after)),
        settles=frozenset(settles),
        devices=frozenset(step.arguments[name] for name in locked[step.skill] if name in step.arguments),
    )


def _find_reads(step: Step, library: SkillLibrary, state: WorldState, reads: DecidingReads) -> Iterator[FactPattern]:
    """Yield what the preconditions and hold conditions of a step's skill and of all its implementations read."""
    skill = library.skills[step.skill]
    for each in (each for post in skill.post for each in post.effects):
        when = (each.when,) if isinstance(each, ForEach) else ()
        for item in (*when, *bounds_of(single_effect(each))):
            yield from facts_read(item, step.arguments, library.vocabulary)
    ways = ((each.parameters, (*each.pre, *each.hold)) for each in library.implementations_of(skill.name))
    for parameters, requirements in ((skill.parameters, (*skill.pre, *skill.hold)), *ways):
        bindings = bind_in(parameters, step, state)
        for requirement in requirements:
            yield from reads.find(requirement.condition, state, bindings)
