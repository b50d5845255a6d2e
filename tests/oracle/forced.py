"""What a library can reach, found by trying every step in the world model."""

from __future__ import annotations

from collections.abc import Iterator
from heapq import heappop, heappush
from itertools import count, product
from typing import TypeAlias

from skillc_compiler.library.conditions import And, Condition, Literal
from skillc_compiler.library.skills import SkillLibrary
from skillc_compiler.library.vocabulary import ClassType
from skillc_runtime.planning.plan import Plan, Step
from skillc_runtime.planning.validate import PlanError, validate
from skillc_runtime.world.conditions import evaluate
from skillc_runtime.world.state import WorldState

LIMIT = 4000
"""So many states are looked at."""

Fact: TypeAlias = tuple[str, str, str]


class TooManyStates(Exception):
    """A domain is too large for trying everything."""


def relations_of(state: WorldState) -> Iterator[Fact]:
    """Yield every relation that holds."""
    yield from ((relation, *pair) for relation in state.facts for pair in state.pairs(relation))


def worked(step: Step, skills: SkillLibrary, state: WorldState) -> WorldState | None:
    """Return the world after a step, None where the step does not work."""
    try:
        return validate(Plan((step,), 0.0), skills, state, And(()))
    except PlanError:
        return None


def cheapest(skills: SkillLibrary, start: WorldState, goal: Condition) -> float | None:
    """Return the least cost of a sequence of skills that works in the world model; None when there is none."""
    ticket = count()
    queue = [(0.0, next(ticket), start)]
    seen: set[frozenset[object]] = set()
    while queue:
        cost, _, state = heappop(queue)
        key = frozenset(facts_of(state))
        if key in seen:
            continue
        seen.add(key)
        if evaluate(goal, state, {}):
            return cost
        if len(seen) > LIMIT:
            raise TooManyStates
        for step, seconds in steps(skills, state):
            after = worked(step, skills, state)
            if after is not None:
                heappush(queue, (cost + seconds, next(ticket), after))
    return None


def facts_of(state: WorldState) -> Iterator[object]:
    """Yield all that can change."""
    yield from relations_of(state)
    for property_, table in state.stored.items():
        yield from ((property_, *entry) for entry in table.items())


def steps(skills: SkillLibrary, state: WorldState) -> Iterator[tuple[Step, float]]:
    """Yield every skill with every type-correct choice of individuals."""
    for each in skills.skills.values():
        bound = [one for one in each.parameters if one.direction != "opt"]
        names = [one.name for one in bound]
        types = [one.type.iri for one in bound if isinstance(one.type, ClassType)]
        seconds = each.duration.value if isinstance(each.duration, Literal) else 0.0
        for chosen in product(*(sorted(state.instances(cls)) for cls in types)):
            yield Step(each.name, dict(zip(names, chosen, strict=True))), float(seconds)
