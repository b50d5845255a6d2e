"""Formulas and effects of a planning domain, in negation normal form: only atoms and equalities are negated.

A term is a PDDL name: a variable with its leading `?`, or the name of an object.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TypeAlias, assert_never

import msgspec


class Typed(msgspec.Struct, frozen=True):
    """A variable (with its `?`) or an object, and its PDDL type."""

    name: str
    type: str


class Atom(msgspec.Struct, frozen=True):
    """`(predicate term ..)`"""

    predicate: str
    terms: tuple[str, ...]


class Equal(msgspec.Struct, frozen=True):
    """`(= left right)`"""

    left: str
    right: str


class Negation(msgspec.Struct, frozen=True):
    """`(not body)`"""

    body: Atom | Equal


class Conjunction(msgspec.Struct, frozen=True):
    """All parts hold; true when empty."""

    parts: tuple[Formula, ...]


class Disjunction(msgspec.Struct, frozen=True):
    """Some part holds; false when empty."""

    parts: tuple[Formula, ...]


class Existential(msgspec.Struct, frozen=True):
    """The body holds for some object of the variable's type."""

    variable: Typed
    body: Formula


class Universal(msgspec.Struct, frozen=True):
    """The body holds for every object of the variable's type."""

    variable: Typed
    body: Formula


Formula: TypeAlias = Atom | Equal | Negation | Conjunction | Disjunction | Existential | Universal

TRUE = Conjunction(())
FALSE = Disjunction(())


class Change(msgspec.Struct, frozen=True):
    """The atom becomes true (or false): for all values of the variables, where the condition held before.

    An atom that one action both deletes and adds is true afterwards.
    """

    atom: Atom
    positive: bool
    variables: tuple[Typed, ...] = ()
    condition: Formula = TRUE

    @property
    def apart(self) -> Formula | None:
        """The condition without the deleted atom itself, if it consists of inequalities only; None otherwise."""
        rest = [each for each in conjuncts(self.condition) if each != self.atom or self.positive]
        plain = all(isinstance(each, Negation) and isinstance(each.body, Equal) for each in rest)
        return conjunction(rest) if plain else None


def conjunction(parts: Iterable[Formula]) -> Formula:
    """Return the flat conjunction of the parts without duplicates; FALSE if a part is FALSE."""
    flat: dict[Formula, None] = {}
    for part in parts:
        if part == FALSE:
            return FALSE
        flat.update(dict.fromkeys(part.parts if isinstance(part, Conjunction) else (part,)))
    if FALSE in flat:
        return FALSE
    return next(iter(flat)) if len(flat) == 1 else Conjunction(tuple(flat))


def disjunction(parts: Iterable[Formula]) -> Formula:
    """Return the flat disjunction of the parts without duplicates; TRUE if a part is TRUE."""
    flat: dict[Formula, None] = {}
    for part in parts:
        if part == TRUE:
            return TRUE
        flat.update(dict.fromkeys(part.parts if isinstance(part, Disjunction) else (part,)))
    if TRUE in flat:
        return TRUE
    return next(iter(flat)) if len(flat) == 1 else Disjunction(tuple(flat))


def existential(variable: Typed, body: Formula) -> Formula:
    """Return the existential formula, which is false if there is no object of the type.

    A body of TRUE is written as `x = x`: planners drop a quantifier with an empty body, and PDDL has no literal for
    its negation.
    """
    if body == FALSE:
        return FALSE
    return Existential(variable, Equal(variable.name, variable.name) if body == TRUE else body)


def rename_terms(formula: Formula, names: Mapping[str, str]) -> Formula:
    """Return the formula with its terms renamed."""
    match formula:
        case Atom() | Equal():
            return _rename_leaf(formula, names)
        case Negation(body=body):
            return Negation(_rename_leaf(body, names))
        case Conjunction(parts=parts):
            return Conjunction(tuple(rename_terms(part, names) for part in parts))
        case Disjunction(parts=parts):
            return Disjunction(tuple(rename_terms(part, names) for part in parts))
        case Existential(variable=variable, body=body):
            return Existential(variable, rename_terms(body, names))
        case Universal(variable=variable, body=body):
            return Universal(variable, rename_terms(body, names))
        case _:
            assert_never(formula)


def _rename_leaf(formula: Atom | Equal, names: Mapping[str, str]) -> Atom | Equal:
    if isinstance(formula, Atom):
        return Atom(formula.predicate, tuple(names.get(term, term) for term in formula.terms))
    return Equal(names.get(formula.left, formula.left), names.get(formula.right, formula.right))


def conjuncts(formula: Formula) -> tuple[Formula, ...]:
    """Return the parts of a conjunction, or the formula alone."""
    return formula.parts if isinstance(formula, Conjunction) else (formula,)


def atoms(formula: Formula) -> Iterator[Atom]:
    """Yield every atom in the formula."""
    match formula:
        case Atom():
            yield formula
        case Equal():
            pass
        case Conjunction(parts=parts) | Disjunction(parts=parts):
            for part in parts:
                yield from atoms(part)
        case Negation(body=body) | Existential(body=body) | Universal(body=body):
            yield from atoms(body)
        case _:
            assert_never(formula)
