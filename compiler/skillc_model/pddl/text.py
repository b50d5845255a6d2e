"""PDDL text of domains and problems: Jinja2 templates define the layout, this module formats formulas and effects."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from functools import cache
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, assert_never

from skillc_model.pddl.domain import Action, ComputedCost, Cost, FixedCost, GuardMeaning, PlanningDomain, Predicate
from skillc_model.pddl.formulas import (
    TRUE,
    Atom,
    Change,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Typed,
    Universal,
    atoms,
    conjunction,
    conjuncts,
)
from skillc_model.pddl.problem import Problem
from skillc_model.templates import open_templates

if TYPE_CHECKING:
    from jinja2 import Template


ORDER = (
    ":strips",
    ":typing",
    ":negative-preconditions",
    ":disjunctive-preconditions",
    ":equality",
    ":existential-preconditions",
    ":universal-preconditions",
    ":conditional-effects",
    ":action-costs",
)


def find_requirements(domain: PlanningDomain) -> tuple[str, ...]:
    """Return the requirements of the classical domain."""
    used = {":strips", ":typing", ":action-costs"}
    for action in domain.actions:
        used |= set(_of(action.precondition)) | set(_of(action.hold))
        for change in action.effects:
            used |= {":conditional-effects"} if change.variables else set()
            used |= set(_of(change.condition))
    return tuple(each for each in ORDER if each in used)


def _of(formula: Formula) -> Iterator[str]:
    match formula:
        case Atom():
            pass
        case Equal():
            yield ":equality"
        case Negation(body=body):
            yield ":negative-preconditions"
            yield from _of(body)
        case Conjunction(parts=parts):
            yield from (each for part in parts for each in _of(part))
        case Disjunction(parts=parts):
            yield ":disjunctive-preconditions"
            yield from (each for part in parts for each in _of(part))
        case Existential(body=body):
            yield ":existential-preconditions"
            yield from _of(body)
        case Universal(body=body):
            yield ":universal-preconditions"
            yield from _of(body)
        case _:
            assert_never(formula)


WIDTH = 100


def format_domain(domain: PlanningDomain) -> str:
    """Return the classical domain with action costs; hold conditions are part of the preconditions."""
    return _template("domain.pddl.j2").render(domain=domain, requirements=find_requirements(domain))


def format_temporal_domain(domain: PlanningDomain) -> str:
    """Return the domain with durative actions: hold conditions are `over all`, devices in use are locked."""
    needed = [each for each in find_requirements(domain) if each != ":action-costs"]
    numbers = [":numeric-fluents"] if domain.costs else []
    return _template("temporal.pddl.j2").render(domain=domain, requirements=(*needed, *numbers, ":durative-actions"))


def format_problem(problem: Problem) -> str:
    """Return the problem for the classical domain."""
    return _template("problem.pddl.j2").render(problem=problem, objects=_declared(problem), idle=(), temporal=False)


def format_temporal_problem(problem: Problem) -> str:
    """Return the problem for the temporal domain: no device is in use initially; the makespan is minimised."""
    idle = _lockable(problem)
    return _template("problem.pddl.j2").render(problem=problem, objects=_declared(problem), idle=idle, temporal=True)


def _lockable(problem: Problem) -> list[str]:
    """Return the names of the objects that some action may lock."""
    locks = {each.type for action in problem.domain.actions for each in action.parameters if each.name in action.uses}
    return [each.name for each in problem.objects if any(problem.domain.is_a(each.type, lock) for lock in locks)]


def _declared(problem: Problem) -> list[Typed]:
    constants = {each.name for each in problem.domain.constants}
    return [each for each in problem.objects if each.name not in constants]


@cache
def _template(name: str) -> Template:
    environment = open_templates(Path(__file__).parent)
    environment.filters |= {
        "cost": format_cost,
        "declared": format_typed,
        "effect": format_effect,
        "formula": format_formula,
        "lines": str.splitlines,
        "meaning": _meaning_lines,
        "scale": _format_scale,
        "precondition": lambda action: format_formula(_classical(action), 4),
        "start": lambda action: conjuncts(_classical(action)),
        "conjuncts": conjuncts,
        "durative": _durative,
        "types": _type_lines,
    }
    return environment.get_template(name)


def _classical(action: Action) -> Formula:
    return conjunction((action.precondition, action.hold))


def format_typed(typed: Iterable[Typed]) -> str:
    """Return `?a - type ?b - type`."""
    return " ".join(f"{each.name} - {each.type}" for each in typed)


def format_cost(cost: Cost, domain: PlanningDomain) -> str:
    """Return the cost of an action: the number in units of the domain, or the function."""
    match cost:
        case FixedCost(seconds=seconds):
            return str(domain.units(seconds))
        case ComputedCost(function=function, arguments=arguments):
            return _list(function, arguments)
        case _:
            assert_never(cost)


def format_formula(formula: Formula, indent: int = 0) -> str:
    """Return the formula, on one line if it fits, otherwise with one part per line."""
    match formula:
        case Atom(predicate=predicate, terms=terms):
            return _list(predicate, terms)
        case Equal(left=left, right=right):
            return f"(= {left} {right})"
        case Negation(body=body):
            return f"(not {format_formula(body)})"
        case Conjunction(parts=parts):
            return _block("and", parts, indent)
        case Disjunction(parts=parts):
            return _block("or", parts, indent)
        case Existential(variable=variable, body=body):
            return f"(exists ({format_typed((variable,))}) {format_formula(body, indent)})"
        case Universal(variable=variable, body=body):
            return f"(forall ({format_typed((variable,))}) {format_formula(body, indent)})"
        case _:
            assert_never(formula)


def format_effect(change: Change) -> str:
    """Return one effect of a classical action."""
    effect = _literal(change)
    if change.condition != TRUE:
        effect = f"(when {format_formula(change.condition)} {effect})"
    return f"(forall ({format_typed(change.variables)}) {effect})" if change.variables else effect


def is_used_up(change: Change, action: Action) -> bool:
    """Whether a durative action deletes at its start an atom that it reads there and does not need until its end."""
    deleted = not change.positive and change.condition == TRUE and not change.variables
    return deleted and change.atom in conjuncts(action.precondition) and change.atom not in atoms(action.hold)


def _durative(change: Change, action: Action) -> str:
    """Return one effect of a durative action: `at end`, but `at start` for an atom that it uses up.

    Otherwise two overlapping actions could use up the same atom.
    """
    if is_used_up(change, action):
        return f"(at start {_literal(change)})"
    effect = f"(at end {_literal(change)})"
    if change.condition != TRUE:
        effect = f"(when (at end {format_formula(change.condition)}) {effect})"
    return f"(forall ({format_typed(change.variables)}) {effect})" if change.variables else effect


def _literal(change: Change) -> str:
    return format_formula(change.atom if change.positive else Negation(change.atom))


def _list(head: str, terms: Sequence[str]) -> str:
    return f"({' '.join((head, *terms))})"


def _block(word: str, parts: Sequence[Formula], indent: int) -> str:
    flat = _list(word, [format_formula(part) for part in parts])
    if word == "or" and not parts:
        raise ValueError("PDDL has no word for false: a condition that can never hold must be reported before printing")
    if len(flat) + indent <= WIDTH:
        return flat
    inner = " " * (indent + 2)
    lines = "".join(f"\n{inner}{format_formula(part, indent + 2)}" for part in parts)
    return f"({word}{lines}\n{' ' * indent})"


def _format_scale(scale: Fraction) -> str:
    if scale == 1:
        return "a unit is a second"
    if scale.numerator == 1:
        return f"a unit is {scale.denominator} seconds"
    return f"{scale} units are a second"


def _meaning_lines(predicate: Predicate) -> list[str]:
    """Return the comment lines above a predicate whose name does not explain it: the condition as written."""
    match predicate.meaning:
        case GuardMeaning(skill=skill, label=label, text=text):
            return [f"`{label}` of {skill}: {' '.join(text.split())}"]
    return []


def _type_lines(domain: PlanningDomain) -> list[str]:
    by_parent = sorted(domain.types, key=lambda each: (each.depth, each.parent, each.name))
    groups = groupby(by_parent, key=lambda each: each.parent)
    return [f"{' '.join(each.name for each in group)} - {parent}" for parent, group in groups]
