"""`exists` and `forall` in the form in which states keep them, and what they say of single individuals."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from skillc_compiler.analysis.sorts import Sorts
from skillc_compiler.analysis.state import State, Thing
from skillc_model.conditions import And, Anything, Condition, Exists, Forall, Holds, Individual, Not, Or, Term, Variable
from skillc_model.reading import conjuncts, walk
from skillc_model.rewriting import substitute
from skillc_rdf.vocabulary.types import THING

BOUND = "|"
"""The names that quantifiers bind in this form begin with it; no name in a file does."""


def is_bound(term: Term) -> bool:
    """Whether a quantifier binds the name."""
    return isinstance(term, Variable) and term.name.startswith(BOUND)


def quantified(sorts: Sorts, condition: Exists | Forall, canonical: Callable[[Condition], Condition]) -> Condition:
    """Return a quantifier in the one form of all that mean the same; `canonical` gives that of its body.

    `forall x (c)` is `not exists x (not c)`, an `exists` over an `or` is an `or`, and where a relation goes to nothing
    but individuals of the class, `exists x: C (a REL x)` is `a REL _`.
    """
    if isinstance(condition, Forall):
        return _negation(quantified(sorts, Exists(condition.variable, condition.cls, Not(condition.body)), canonical))
    body, name = condition.body, condition.variable
    if not name.startswith(BOUND):
        body, name = substitute(body, {name: Variable(BOUND + name)}), BOUND + name
    body = _pushed(canonical(body))
    variable = Variable(f"{BOUND}{1 + max(_depths(body), default=0)}")
    body = substitute(body, {name: variable})
    match body:
        case Or(parts=parts):
            return Or(tuple(quantified(sorts, Exists(variable.name, condition.cls, part), canonical) for part in parts))
        case Holds(subject=subject, relation=relation, object=object_) if object_ == variable != subject:
            if _covers(sorts, condition.cls, relation, is_subject=False):
                return Holds(subject, relation, Anything())
        case Holds(subject=subject, relation=relation, object=object_) if subject == variable != object_:
            if _covers(sorts, condition.cls, relation, is_subject=True):
                return Holds(Anything(), relation, object_)
    return Exists(variable.name, condition.cls, body)


def only(state: State, condition: Exists) -> Iterator[frozenset[Thing]]:
    """Yield groups outside of which nobody fulfils the condition: those that alone may have a relation it asks."""
    variable = Variable(condition.variable)
    for part in conjuncts(condition.body):
        match part:
            case Holds(subject=Variable() | Individual() as near, relation=relation, object=far) if far == variable:
                yield from _alone(state, relation, near, True)
            case Holds(subject=far, relation=relation, object=Variable() | Individual() as near) if far == variable:
                yield from _alone(state, relation, near, False)


def is_ruled_out(sorts: Sorts, state: State, asked: Condition) -> bool:
    """Whether no individual is such that a condition holds, and this one of an individual would make one such."""
    nobody = [fact for fact, true in state.facts.items() if not true and isinstance(fact, Exists)]
    for fact in nobody:
        for thing in {part for part in walk(asked) if isinstance(part, Variable | Individual)}:
            parts = tuple(conjuncts(substitute(fact.body, {fact.variable: thing})))
            known = all(part == asked or _is_known(state, part) for part in parts)
            if asked in parts and known and sorts.is_a(state, thing, fact.cls):
                return True
    return False


def _is_known(state: State, condition: Condition) -> bool:
    if isinstance(condition, Not):
        return state.facts.get(condition.body) is False
    return state.facts.get(condition) is True


def _alone(state: State, relation: str, near: Thing, is_subject: bool) -> Iterator[frozenset[Thing]]:
    group = state.alone.get((relation, near, is_subject))
    if group is not None:
        yield group


def _covers(sorts: Sorts, cls: str, relation: str, is_subject: bool) -> bool:
    """Whether all that stand on one side of a relation are of the class."""
    if cls == THING:
        return True
    term = sorts.vocabulary.relations.get(relation)
    if term is None or sorts.is_computed(relation):
        return False
    ends = [signature.domain if is_subject else signature.range for signature in term.signatures]
    return bool(ends) and all(sorts.vocabulary.is_a(end, cls) for end in ends)


def _pushed(condition: Condition) -> Condition:
    """Return the condition with `not` as far inside as it goes, so that what is joined can be seen."""
    match condition:
        case Not(body=Not(body=body)):
            return _pushed(body)
        case Not(body=And(parts=parts)):
            return Or(tuple(_pushed(Not(part)) for part in parts))
        case Not(body=Or(parts=parts)):
            return And(tuple(_pushed(Not(part)) for part in parts))
    return condition


def _negation(condition: Condition) -> Condition:
    return condition.body if isinstance(condition, Not) else Not(condition)


def _depths(condition: Condition) -> Iterator[int]:
    """Yield the numbers that are the names of quantifiers in a condition in this form."""
    return (int(each.variable.removeprefix(BOUND)) for each in walk(condition) if isinstance(each, Exists))
