"""What a library can reach, found by trying every step in the world model."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from heapq import heappop, heappush
from itertools import count, product
from typing import TypeAlias

from skillc_model.conditions import And, Condition
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.types import ClassType
from skillc_runtime.execution.selection.binding import BoundImplementation, bind_implementation
from skillc_runtime.planning.plan import Plan, Step
from skillc_runtime.planning.validation import PlanError, validate
from skillc_runtime.world.eval.conditions import evaluate
from skillc_runtime.world.eval.expressions import value_of
from skillc_runtime.world.state.python_calls import EvaluationError
from skillc_runtime.world.state.world_state import WorldState

LIMIT = 4000
"""So many states are looked at."""

STEPS_EACH = 20
"""So many steps are tried, for each of them."""

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


def cheapest(skills: SkillLibrary, start: WorldState, goal: Condition, limit: int = LIMIT) -> float | None:
    """Return the least cost of a sequence of skills that works in the world model; None when there is none."""
    ticket = count()
    queue = [(Fraction(0), next(ticket), start)]
    seen: set[frozenset[object]] = set()
    tried = 0
    while queue:
        cost, _, state = heappop(queue)
        key = frozenset(facts_of(state))
        if key in seen:
            continue
        seen.add(key)
        if evaluate(goal, state, {}):
            return float(cost)
        if len(seen) > limit:
            raise TooManyStates
        for step in steps(skills, state):
            tried += 1
            if tried > STEPS_EACH * limit:
                raise TooManyStates
            after = worked(step, skills, state)
            if after is not None:
                heappush(queue, (cost + seconds(step, skills, state, start), next(ticket), after))
    return None


def facts_of(state: WorldState) -> Iterator[object]:
    """Yield all that can change."""
    yield from relations_of(state)
    for property_, table in state.stored.items():
        yield from ((property_, *entry) for entry in table.items())


def steps(skills: SkillLibrary, state: WorldState) -> Iterator[Step]:
    """Yield every skill with every type-correct choice of individuals; optional parameters are not passed."""
    for each in skills.skills.values():
        passed = [one for one in each.parameters if one.direction in ("in", "infer")]
        types = [one.type.iri for one in passed if isinstance(one.type, ClassType)]
        for chosen in product(*(sorted(state.instances(cls)) for cls in types)):
            yield Step(each.name, dict(zip((one.name for one in passed), chosen, strict=True)))


def seconds(step: Step, skills: SkillLibrary, state: WorldState, start: WorldState) -> Fraction:
    """Return how long a step takes that starts in a state, by the implementation that a call would take there.

    One that nobody says or that has no value is taken for a second. Durations were drawn with a few decimals: the
    nearest such number to a float is what was meant.
    """
    for each in skills.implementations_of(step.skill):
        fitted = bind_implementation(each, step.arguments, state)
        if isinstance(fitted, BoundImplementation) and all(
            evaluate(one.condition, state, fitted.bindings) for one in each.hold
        ):
            if each.duration is None:
                return Fraction(1)
            try:
                value = value_of(each.duration, start, fitted.bindings)
            except EvaluationError:
                return Fraction(1)
            assert isinstance(value, int | float)
            return Fraction(value).limit_denominator(10**5)
    raise AssertionError(f"no implementation takes {step}")
