"""The atoms and terms of actions, with the types of their terms."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeAlias, assert_never

from skillc_model.pddl.domain import Action
from skillc_model.pddl.formulas import Atom, Conjunction, Disjunction, Equal, Existential, Formula, Negation, Universal

TypedAtom: TypeAlias = tuple[Atom, tuple[str, ...]]


def typed_atoms(action: Action, constants: Mapping[str, str]) -> Iterator[TypedAtom]:
    """Yield every atom of an action with the types of its terms; `constants` are the types of objects by name."""
    types = {**constants, **{each.name: each.type for each in action.parameters}}
    yield from typed_atoms_in(action.precondition, types)
    yield from typed_atoms_in(action.hold, types)
    for change in action.effects:
        inside = {**types, **{each.name: each.type for each in change.variables}}
        yield from typed_atoms_in(change.atom, inside)
        yield from typed_atoms_in(change.condition, inside)


def typed_atoms_in(formula: Formula, types: Mapping[str, str]) -> Iterator[TypedAtom]:
    """Yield every atom of a formula with the types of its terms."""
    match formula:
        case Atom(terms=terms):
            yield formula, tuple(types[each] for each in terms)
        case Equal():
            pass
        case Negation(body=body):
            yield from typed_atoms_in(body, types)
        case Conjunction(parts=parts) | Disjunction(parts=parts):
            for part in parts:
                yield from typed_atoms_in(part, types)
        case Existential(variable=variable, body=body) | Universal(variable=variable, body=body):
            yield from typed_atoms_in(body, {**types, variable.name: variable.type})
        case _:
            assert_never(formula)


def action_terms(action: Action) -> frozenset[str]:
    """Return the names of all variables and objects that occur in an action."""
    formulas = [action.precondition, action.hold]
    for change in action.effects:
        formulas += [change.atom, change.condition]
    return frozenset(name for formula in formulas for name in _terms(formula))


def _terms(formula: Formula) -> Iterator[str]:
    match formula:
        case Atom(terms=terms):
            yield from terms
        case Equal(left=left, right=right):
            yield from (left, right)
        case Conjunction(parts=parts) | Disjunction(parts=parts):
            for part in parts:
                yield from _terms(part)
        case Negation(body=body) | Existential(body=body) | Universal(body=body):
            yield from _terms(body)
        case _:
            assert_never(formula)
