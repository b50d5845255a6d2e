"""Whether a condition holds in a state: true, false, or None where what is known leaves it open."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from typing import assert_never

from skillc_compiler.analysis.quantifying import is_bound, is_ruled_out, only, quantified
from skillc_compiler.analysis.sorts import Sorts, same
from skillc_compiler.analysis.state import State, Thing
from skillc_compiler.logic.bounds import MIRRORED, Bound, are_disjoint, decided
from skillc_model.conditions import (
    And,
    Anything,
    Compare,
    Condition,
    Exists,
    Expression,
    Forall,
    Given,
    HasProperty,
    Holds,
    Individual,
    IsA,
    Literal,
    Not,
    Or,
    PropertyOf,
    Same,
    Variable,
)
from skillc_model.reading import walk
from skillc_model.rewriting import substitute


def truth(sorts: Sorts, state: State, condition: Condition) -> bool | None:
    """Return whether the condition holds in every world of which the state's knowledge is true."""
    return _truth(sorts, state, canonical(sorts, state, condition))


def canonical(sorts: Sorts, state: State, condition: Condition) -> Condition:
    """Return the condition in the form in which states keep it: one name for each individual and each relation."""
    if state.same:
        condition = substitute(condition, state.same)
    match condition:
        case Holds(subject=subject, relation=relation, object=object_):
            name, turned = sorts.axioms.name.get(relation, (relation, False))
            return Holds(object_, name, subject) if turned else Holds(subject, name, object_)
        case Not(body=body):
            return Not(canonical(sorts, state, body))
        case And(parts=parts):
            return And(tuple(canonical(sorts, state, part) for part in parts))
        case Or(parts=parts):
            return Or(tuple(canonical(sorts, state, part) for part in parts))
        case Same(left=Variable() | Individual() as left, right=Variable() | Individual() as right):
            return same(left, right)
        case Compare(left=left, operator=sign, right=right) if _is_constant(left) and not _is_constant(right):
            return Compare(right, MIRRORED[sign], left)
        case Exists() | Forall():
            return quantified(sorts, condition, lambda body: canonical(sorts, state, body))
    return condition


def _truth(sorts: Sorts, state: State, condition: Condition) -> bool | None:
    match condition:
        case Holds():
            return _related(sorts, state, condition)
        case Not(body=body):
            inner = _truth(sorts, state, body)
            return None if inner is None else not inner
        case And(parts=parts):
            return _all(state.facts.get(condition), [_truth(sorts, state, part) for part in parts])
        case Or(parts=parts):
            known = state.facts.get(condition)
            turned = _all(None if known is None else not known, [_negated(sorts, state, part) for part in parts])
            return None if turned is None else not turned
        case Same(left=left, right=right):
            return _same(sorts, state, left, right)
        case IsA(subject=Variable() | Individual() as subject, cls=cls):
            return sorts.is_a(state, subject, cls)
        case Compare():
            return _compared(sorts, state, condition)
        case HasProperty(subject=subject, property=iri):
            return None if isinstance(subject, Anything) else _has(sorts, state, condition, PropertyOf(subject, iri))
        case Exists():
            return _exists(sorts, state, condition)
        case Forall() | Given() | IsA():
            return state.facts.get(condition)
        case _:
            assert_never(condition)


def _negated(sorts: Sorts, state: State, condition: Condition) -> bool | None:
    inner = _truth(sorts, state, condition)
    return None if inner is None else not inner


def _all(known: bool | None, parts: Iterable[bool | None]) -> bool | None:
    found = list(parts)
    if False in found:
        return False
    return known if None in found else True


def _same(sorts: Sorts, state: State, left: object, right: object) -> bool | None:
    if not isinstance(left, Variable | Individual) or not isinstance(right, Variable | Individual):
        return None
    if left == right:
        return True
    return False if sorts.differ(state, left, right) else None


def _related(sorts: Sorts, state: State, asked: Holds) -> bool | None:
    known = state.facts.get(asked)
    if known is not None:
        return known
    if is_ruled_out(sorts, state, asked):
        return False
    match asked.subject, asked.object:
        case Anything(), Anything():
            return True if any(_holds(state, asked.relation)) else None
        case Anything(), (Variable() | Individual()) as end:
            return _related_to_any(state, asked.relation, end, False)
        case (Variable() | Individual()) as start, Anything():
            return _related_to_any(state, asked.relation, start, True)
        case (Variable() | Individual()) as start, (Variable() | Individual()) as end:
            return False if _excluded(sorts, state, asked.relation, start, end) else None
    return None


def _related_to_any(state: State, relation: str, thing: Thing, is_subject: bool) -> bool | None:
    if any((fact.subject if is_subject else fact.object) == thing for fact in _holds(state, relation)):
        return True
    others = state.alone.get((relation, thing, is_subject))
    if others is None:
        return None
    facts = (Holds(thing, relation, each) if is_subject else Holds(each, relation, thing) for each in others)
    return False if all(state.facts.get(fact) is False for fact in facts) else None


def _excluded(sorts: Sorts, state: State, relation: str, start: Thing, end: Thing) -> bool:
    """Whether what is known of either side, or an axiom, leaves no room for the relation between the two."""
    axioms = sorts.axioms
    if start == end and relation in axioms.irreflexive:
        return True
    if relation in axioms.asymmetric and state.facts.get(Holds(end, relation, start)):
        return True
    for side, other in (((relation, start, True), end), ((relation, end, False), start)):
        rest = state.alone.get(side)
        if rest is not None and all(sorts.differ(state, other, each) for each in rest):
            return True
    for fact in _holds(state, relation):
        if relation in axioms.single_object and fact.subject == start and _apart(sorts, state, fact.object, end):
            return True
        if relation in axioms.single_subject and fact.object == end and _apart(sorts, state, fact.subject, start):
            return True
    return False


def _apart(sorts: Sorts, state: State, one: object, other: Thing) -> bool:
    return isinstance(one, Variable | Individual) and sorts.differ(state, one, other)


def _holds(state: State, relation: str) -> Iterable[Holds]:
    return (f for f, true in state.facts.items() if true and isinstance(f, Holds) and f.relation == relation)


def _exists(sorts: Sorts, state: State, condition: Exists) -> bool | None:
    known = state.facts.get(condition)
    if known is not None:
        return known

    def of(thing: Thing) -> bool | None:
        return _truth(sorts, state, canonical(sorts, state, substitute(condition.body, {condition.variable: thing})))

    if any(sorts.is_a(state, thing, condition.cls) and of(thing) for thing in things(state)):
        return True
    return False if any(all(of(one) is False for one in group) for group in only(state, condition)) else None


def things(state: State) -> tuple[Thing, ...]:
    """Return the individuals of which something is known, in the order in which it became known."""
    return tuple(dict.fromkeys(thing for fact in state.facts for thing in _things_in(fact)))


@lru_cache(maxsize=4096)
def _things_in(fact: Condition) -> tuple[Thing, ...]:
    terms = (part for part in walk(fact) if isinstance(part, Variable | Individual))
    return tuple(dict.fromkeys(term for term in terms if not is_bound(term)))


def _compared(sorts: Sorts, state: State, asked: Compare) -> bool | None:
    known = state.facts.get(asked)
    if known is not None:
        return known
    if isinstance(asked.left, Literal) and isinstance(asked.right, Literal):
        return decided(asked.operator, asked.left.value, asked.right.value)
    if is_ruled_out(sorts, state, asked):
        return False
    if asked.left == asked.right and isinstance(asked.left, Variable):
        return asked.operator in ("==", "<=", ">=")
    if _is_missing(state, asked.left):
        return False
    if not _is_single(sorts, asked.left):
        return None
    for fact, true in state.facts.items():
        if isinstance(fact, Compare) and fact.left == asked.left:
            answer = _follows(fact, true, asked)
            if answer is not None:
                return answer
    return None


def _is_missing(state: State, value: Expression) -> bool:
    match value:
        case PropertyOf(of=Variable() | Individual() as of, property=iri):
            return state.facts.get(HasProperty(of, iri)) is False
    return False


def _is_single(sorts: Sorts, value: Expression) -> bool:
    """Whether the value is one; of a property that may have several, each comparison stands alone."""
    if not isinstance(value, PropertyOf):
        return True
    term = sorts.vocabulary.properties.get(value.property)
    return term is not None and term.functional


def _has(sorts: Sorts, state: State, asked: HasProperty, value: PropertyOf) -> bool | None:
    known = state.facts.get(asked)
    if known is not None:
        return known
    if is_ruled_out(sorts, state, asked):
        return False
    compared = (true and fact.left == value for fact, true in state.facts.items() if isinstance(fact, Compare))
    return True if any(compared) else None


def _follows(known: Compare, true: bool, asked: Compare) -> bool | None:
    """Return what one comparison of a value with a constant says of another."""
    if not isinstance(known.right, Literal) or not isinstance(asked.right, Literal) or not true:
        return None
    one = Bound(known.left, known.operator, known.right.value)
    other = Bound(asked.left, asked.operator, asked.right.value)
    if are_disjoint(one, other):
        return False
    return True if are_disjoint(one, other.opposite()) else None


def _is_constant(expression: Expression) -> bool:
    return isinstance(expression, Literal)
