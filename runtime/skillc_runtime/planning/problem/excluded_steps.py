"""Excludes steps from a planning domain: always, or while a condition holds."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from msgspec import structs

from skillc_model.levels import is_level_parameter
from skillc_model.pddl.domain import Action, ExclusionMeaning, PlanningDomain, Predicate
from skillc_model.pddl.formulas import Atom, Equal, Formula, Negation, conjunction, conjuncts, disjunction
from skillc_model.pddl.names import make_unique
from skillc_runtime.planning.plan import Excluded, Step, StepWhile


def exclude_steps(steps: Sequence[Excluded], domain: PlanningDomain, names: Mapping[str, str]) -> PlanningDomain:
    """Return the domain without the steps; `names` are those of the objects, by IRI.

    An action gets a static predicate that is true of the arguments of its steps, and the precondition that it is false.
    A disjunction of inequalities would say the same, but planners expand disjunctions, and several multiply.
    """
    each_step = [each.step if isinstance(each, StepWhile) else each for each in steps]
    for number, action in enumerate(domain.actions):
        arguments = _arguments_of(action, each_step, names)
        if arguments:
            domain, meant = _add_predicate(domain, f"excluded-{action.name}", action, arguments)
            allowed = conjunction((action.precondition, Negation(meant)))
            actions = list(domain.actions)
            actions[number] = structs.replace(action, precondition=allowed)
            domain = replace(domain, actions=tuple(actions))
    return domain


def allow_steps(
    forbidden: Iterable[tuple[Step, Formula]],
    excluded: PlanningDomain,
    before: PlanningDomain,
    names: Mapping[str, str],
) -> PlanningDomain:
    """Return a domain from which steps are excluded, with those that are allowed unless their conditions hold.

    Each is an action of its own, for these arguments only: so what planners expand is expanded for nothing else.
    `before` is the domain in which nothing was excluded.
    """
    conditions: dict[tuple[str, tuple[str, ...]], list[Formula]] = {}
    for step, condition in forbidden:
        for action in before.actions:
            for arguments in _arguments_of(action, [step], names):
                conditions.setdefault((action.name, arguments), []).append(condition)
    found = excluded
    for action in before.actions:
        for (name, arguments), held in conditions.items():
            if name == action.name:
                found, meant = _add_predicate(found, f"only-{action.name}", action, (arguments,))
                free = [negate(each) for each in held]
                copy = make_unique(f"{action.name}-again", {each.name for each in found.actions} | {*found.names})
                again = structs.replace(
                    action, name=copy, precondition=conjunction((action.precondition, meant, *free))
                )
                found = replace(found, actions=(*found.actions, again))
    return found


def negate(condition: Formula) -> Formula:
    """Return that a conjunction of literals does not hold; ValueError for anything else, which excludes no step."""
    return disjunction(map(_negate_literal, conjuncts(condition)))


def _negate_literal(literal: Formula) -> Formula:
    match literal:
        case Atom() | Equal():
            return Negation(literal)
        case Negation(body):
            return body
        case _:
            raise ValueError(f"{literal} is no literal")


def _arguments_of(action: Action, steps: Iterable[Step], names: Mapping[str, str]) -> tuple[tuple[str, ...], ...]:
    """Return the arguments (IRIs) that an action has in steps whose individuals are all objects of the problem."""
    return tuple(
        tuple(step.arguments[each] for each in action.binds if not is_level_parameter(each))
        for step in steps
        if step.skill == action.skill and names.keys() >= set(step.arguments.values())
    )


def _add_predicate(
    domain: PlanningDomain, name: str, action: Action, arguments: tuple[tuple[str, ...], ...]
) -> tuple[PlanningDomain, Atom]:
    """Return the domain with a static predicate that is true of arguments of an action, and its atom there."""
    unique = make_unique(name, {*domain.names, *domain.predicate})
    stated = [each for each, name in zip(action.parameters, action.binds, strict=True) if not is_level_parameter(name)]
    added = Predicate(unique, tuple(stated), ExclusionMeaning(arguments), changes=False)
    atom = Atom(unique, tuple(each.name for each in stated))
    return replace(domain, predicates=(*domain.predicates, added)), atom
