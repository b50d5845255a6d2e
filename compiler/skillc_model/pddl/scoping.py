"""Moves the quantifiers of formulas inwards (see `skillc_model.scopes`), so that whoever expands them does less."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_model.pddl.formulas import (
    Atom,
    Conjunction,
    Disjunction,
    Equal,
    Existential,
    Formula,
    Negation,
    Typed,
    Universal,
    conjunction,
    existential,
)
from skillc_model.scopes import Nesting


def narrow_scopes(formula: Existential) -> Formula:
    """Return an equivalent formula with its variables in an order in which parts of the body connect them."""
    variables = {formula.variable.name: formula.variable}
    parts = [(part, _terms(part)) for part in _list_parts(formula.body, variables)]
    if len(variables) == 1:
        return formula
    return Nesting(parts, lambda name, body: existential(variables[name], body), conjunction).nest(list(variables))


def _list_parts(formula: Formula, variables: dict[str, Typed]) -> Iterator[Formula]:
    """Yield the parts of a body; add the variables of its quantifiers to `variables`, unless the name is taken."""
    match formula:
        case Conjunction(parts):
            for part in parts:
                yield from _list_parts(part, variables)
        case Existential(variable, body) if variable.name not in variables:
            variables[variable.name] = variable
            yield from _list_parts(body, variables)
        case _:
            yield formula


def _terms(formula: Formula) -> frozenset[str]:
    """Return the terms of a formula, those of its own quantifiers excluded."""
    match formula:
        case Atom(terms=terms):
            return frozenset(terms)
        case Equal(left, right):
            return frozenset((left, right))
        case Negation(body):
            return _terms(body)
        case Conjunction(parts) | Disjunction(parts):
            return frozenset().union(*map(_terms, parts))
        case Existential(variable, body) | Universal(variable, body):
            return _terms(body) - {variable.name}
