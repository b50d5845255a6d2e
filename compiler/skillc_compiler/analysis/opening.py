"""What is known when the body of an implementation begins."""

from __future__ import annotations

from collections.abc import Iterable

from skillc_compiler.analysis.binding import class_of
from skillc_compiler.analysis.learning import learned
from skillc_compiler.analysis.sorts import Sorts
from skillc_compiler.analysis.state import State, Thing
from skillc_compiler.program.typed import Implementation, Parameter, Requirement, Task
from skillc_compiler.program.types import Thing as ThingType
from skillc_model.conditions import Compare, Condition, Given, Individual, Literal, Variable
from skillc_model.rewriting import constant_number
from skillc_rdf.vocabulary.types import THING


def requirements_of(implementation: Implementation, kind: str) -> tuple[Requirement, ...]:
    """Return the conditions of a kind, those of the description first."""
    both = (*implementation.skill.requirements, *implementation.requirements)
    return tuple(each for each in both if each.kind == kind)


def name_sorts(sorts: Sorts, of: Implementation | Task) -> None:
    """Note the class of each parameter and of each named individual."""
    if isinstance(of, Implementation):
        sorts.classes.update({p.name: class_of(p) for p in of.parameters})
        for let in of.lets:
            if isinstance(let.value.type, ThingType):
                sorts.classes[let.name.text] = let.value.type.cls or THING


def opening(sorts: Sorts, implementation: Implementation) -> State:
    """Return the state at the start: preconditions and holds hold, numbers are in range, lets are named."""
    state = unconditional(implementation)
    for requirement in _required(implementation):
        state = learned(sorts, state, requirement.clause.meaning) or state
    return state


def can_start(sorts: Sorts, implementation: Implementation) -> bool:
    """Whether the preconditions and holds do not contradict each other."""
    state: State | None = unconditional(implementation)
    for requirement in _required(implementation):
        state = learned(sorts, state, requirement.clause.meaning) if state is not None else None
    return state is not None


def _required(implementation: Implementation) -> tuple[Requirement, ...]:
    return (*requirements_of(implementation, "pre"), *requirements_of(implementation, "hold"))


def unconditional(implementation: Implementation) -> State:
    """Return what is known without the conditions: numbers are in range, lets are named."""
    return State(facts=dict(_ranges(implementation.parameters)), same=_lets(implementation))


def _lets(implementation: Implementation) -> dict[str, Thing]:
    found: dict[str, Thing] = {}
    for let in implementation.lets:
        meaning = let.value.meaning
        if isinstance(meaning, Variable | Individual):
            found[let.name.text] = found.get(meaning.name, meaning) if isinstance(meaning, Variable) else meaning
    return found


def _ranges(parameters: Iterable[Parameter]) -> Iterable[tuple[Condition, bool]]:
    for parameter in parameters:
        if not parameter.may_be_unset:
            yield Given(parameter.name), True
        for bound, sign in ((parameter.low, ">="), (parameter.high, "<=")):
            limit = constant_number(bound.meaning) if bound is not None else None
            if limit is not None and not parameter.may_be_unset:
                yield Compare(Variable(parameter.name), sign, Literal(limit)), True  # type: ignore[arg-type]
