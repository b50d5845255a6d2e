"""Which steps of a plan have to wait for which, and how they are arranged one after the other and side by side."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from skillc_compiler.library.conditions import Condition
from skillc_compiler.library.pddl.devices import devices
from skillc_compiler.library.skills import SkillLibrary
from skillc_runtime.planning.plan import Plan, Step
from skillc_runtime.planning.validation import apply_step, compute_effects
from skillc_runtime.plans.touched import Touched, changed_between, read_by, settled_by
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class InOrder:
    """Parts one after the other."""

    parts: tuple[Arrangement, ...]


@dataclass(frozen=True, slots=True)
class Together:
    """Parts side by side."""

    parts: tuple[Arrangement, ...]


Arrangement: TypeAlias = "int | InOrder | Together"
"""Steps by their number in the plan, from 0."""


def arranged(plan: Plan, library: SkillLibrary, state: WorldState) -> Arrangement:
    """Return the plan with steps side by side wherever the world they leave and the devices they use allow it.

    A step waits for an earlier one that changes what it reads, reads what it changes, settles the same facts or locks
    the same device: a partial order in which every sequence of the steps has the same effect (Bäckström 1998, block
    deordering without blocks). PlanError when the plan does not work from this version of the world.
    """
    earlier = waited_for(plan, library, state)
    return arrange(range(len(earlier)), lambda one, other: one in earlier[other])


def waited_for(plan: Plan, library: SkillLibrary, state: WorldState) -> tuple[frozenset[int], ...]:
    """Return for each step the earlier ones that have to be over first; PlanError when the plan does not work."""
    touched = _touched(plan.steps, library, state)
    earlier: list[frozenset[int]] = []
    for late in range(len(touched)):
        direct = [early for early in range(late) if touched[early].conflicts(touched[late])]
        earlier.append(frozenset(direct).union(*(earlier[each] for each in direct)))
    return tuple(earlier)


def arrange(steps: Sequence[int], before: Callable[[int, int], bool]) -> Arrangement:
    """Return steps of a partial order, given by `before`, in series and in parallel.

    An order that is not made of the two alone gets as little more of it as needed: those that wait for nobody first.
    """
    if len(steps) < 2:
        return steps[0] if steps else InOrder(())
    side_by_side = _components(steps, lambda one, other: before(one, other) or before(other, one))
    if len(side_by_side) > 1:
        return Together(tuple(arrange(part, before) for part in side_by_side))
    in_order = _components(steps, lambda one, other: not before(one, other) and not before(other, one))
    if len(in_order) == 1:
        first = [each for each in steps if not any(before(other, each) for other in steps)]
        in_order = [first, [each for each in steps if each not in first]]
    return _flat(InOrder(tuple(arrange(part, before) for part in in_order)))


def numbers(arrangement: Arrangement) -> tuple[int, ...]:
    """Return the steps in the order in which they stand."""
    if isinstance(arrangement, int):
        return (arrangement,)
    return tuple(number for part in arrangement.parts for number in numbers(part))


def _flat(series: InOrder) -> InOrder:
    parts: list[Arrangement] = []
    for part in series.parts:
        parts.extend(part.parts if isinstance(part, InOrder) else (part,))
    return InOrder(tuple(parts))


def _components(steps: Iterable[int], linked: Callable[[int, int], bool]) -> list[list[int]]:
    """Return the steps in groups that hang together, each in order, by the first of each."""
    groups: list[list[int]] = []
    for step in steps:
        meeting = [group for group in groups if any(linked(step, other) for other in group)]
        merged = sorted([step, *(each for group in meeting for each in group)])
        groups = [group for group in groups if group not in meeting] + [merged]
    return sorted(groups)


def _touched(steps: Iterable[Step], library: SkillLibrary, state: WorldState) -> list[Touched]:
    locked = devices(library)
    found = []
    for step in steps:
        after = apply_step(step, library, state)
        found.append(touched_by(step, library, locked, state, after))
        state = after
    return found


def touched_by(
    step: Step, library: SkillLibrary, locked: Mapping[str, tuple[str, ...]], before: WorldState, after: WorldState
) -> Touched:
    """Return what a step touches that leads from one version of the world to another; `locked` as of `devices`."""
    reads = (fact for each in _conditions(step, library) for fact in read_by(each, step.arguments, before))
    settles = (fact for each in compute_effects(step, library, before) for fact in settled_by(each, before))
    return Touched(
        reads=frozenset(reads),
        changes=frozenset(changed_between(before, after)),
        settles=frozenset(settles),
        devices=frozenset(step.arguments[name] for name in locked[step.skill] if name in step.arguments),
    )


def _conditions(step: Step, library: SkillLibrary) -> Iterator[Condition]:
    """Yield what must hold when a step starts and while it runs, whichever implementation is taken."""
    skill = library.skills[step.skill]
    alternatives = ((each.pre, each.hold) for each in library.implementations_of(skill.name))
    for requirements in ((skill.pre, skill.hold), *alternatives):
        yield from (requirement.condition for group in requirements for requirement in group)
