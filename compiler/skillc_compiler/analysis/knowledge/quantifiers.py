"""Normal forms of `exists` and `forall`, and what they imply for single individuals."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.state import IndividualTerm, State
from skillc_model.conditions import And, Anything, Condition, Exists, Forall, Holds, Individual, Not, Or, Term, Variable
from skillc_model.rewriting import substitute
from skillc_model.traversal import conjuncts, walk
from skillc_rdf.vocabulary.types import THING

BOUND_PREFIX = "|"
"""The prefix of names bound by quantifiers in the normal form; no name in a file begins with it."""


def is_bound_variable(term: Term) -> bool:
    """Whether a quantifier binds the name."""
    return isinstance(term, Variable) and term.name.startswith(BOUND_PREFIX)


def known_individuals(state: State) -> tuple[IndividualTerm, ...]:
    """Return the individuals of which something is known, in the order in which it became known."""
    return tuple(dict.fromkeys(thing for fact in state.facts for thing in _individuals_in(fact)))


@lru_cache(maxsize=16384)
def _individuals_in(fact: Condition) -> tuple[IndividualTerm, ...]:
    return tuple(term for term in _terms_in(fact) if not is_bound_variable(term))


@lru_cache(maxsize=16384)
def _terms_in(fact: Condition) -> tuple[IndividualTerm, ...]:
    return tuple(dict.fromkeys(part for part in walk(fact) if isinstance(part, Variable | Individual)))


def normalise_quantifier(
    types: AliasTypes, condition: Exists | Forall, canonical: Callable[[Condition], Condition]
) -> Condition:
    """Return the one normal form of all equivalent quantifiers; `canonical` normalises the body.

    `forall x (c)` is `not exists x (not c)`, an `exists` over an `or` is an `or`, and if a relation has only
    individuals of the class as objects, `exists x: C (a REL x)` is `a REL _`.
    """
    if isinstance(condition, Forall):
        return _negate(
            normalise_quantifier(types, Exists(condition.variable, condition.cls, Not(condition.body)), canonical)
        )
    body, name = condition.body, condition.variable
    if not name.startswith(BOUND_PREFIX):
        body, name = substitute(body, {name: Variable(BOUND_PREFIX + name)}), BOUND_PREFIX + name
    body = _push_negation(canonical(body))
    variable = Variable(f"{BOUND_PREFIX}{1 + max(_depths(body), default=0)}")
    body = substitute(body, {name: variable})
    match body:
        case Or(parts=parts):
            return Or(
                tuple(
                    normalise_quantifier(types, Exists(variable.name, condition.cls, part), canonical) for part in parts
                )
            )
        case Holds(subject=subject, relation=relation, object=object_) if object_ == variable != subject:
            if _covers(types, condition.cls, relation, is_subject=False):
                return Holds(subject, relation, Anything())
        case Holds(subject=subject, relation=relation, object=object_) if subject == variable != object_:
            if _covers(types, condition.cls, relation, is_subject=True):
                return Holds(Anything(), relation, object_)
    return Exists(variable.name, condition.cls, body)


def possible_witnesses(state: State, condition: Exists) -> Iterator[frozenset[IndividualTerm]]:
    """Yield groups outside of which no individual satisfies the condition: the possible values of a relation in it."""
    variable = Variable(condition.variable)
    for part in conjuncts(condition.body):
        match part:
            case Holds(subject=Variable() | Individual() as near, relation=relation, object=far) if far == variable:
                yield from _possible(state, relation, near, True)
            case Holds(subject=far, relation=relation, object=Variable() | Individual() as near) if far == variable:
                yield from _possible(state, relation, near, False)


def is_ruled_out(types: AliasTypes, state: State, asked: Condition) -> bool:
    """Whether no individual satisfies a known-false `exists`, and the asked condition would make one satisfy it."""
    for fact in state.denied:
        for thing in _terms_in(asked):
            parts = _parts_of(fact, thing)
            known = asked in parts and all(part == asked or _is_known(state, part) for part in parts)
            if known and types.is_a(state, thing, fact.cls):
                return True
    return False


@lru_cache(maxsize=16384)
def _parts_of(fact: Exists, thing: IndividualTerm) -> tuple[Condition, ...]:
    """Return what an individual has to fulfil to be one that exists."""
    return tuple(conjuncts(substitute(fact.body, {fact.variable: thing})))


def implies(types: AliasTypes, known: Condition, asked: Condition) -> bool:
    """Whether a condition, part for part, says at least what another one says."""
    match known, asked:
        case Holds(subject, relation, object_), Holds(start, above, end):
            implied = types.axioms.implied.get(relation, ((relation, False),))
            ends = {(start, end): False, (end, start): True}
            return (above, ends.get((subject, object_))) in implied
        case Or(parts), Or(others):
            return all(any(implies(types, part, other) for other in others) for part in parts)
        case And(parts), And(others):
            return all(any(implies(types, part, other) for part in parts) for other in others)
        case Exists(name, cls, body), Exists(other, above, weaker):
            return name == other and types.vocabulary.is_a(cls, above) and implies(types, body, weaker)
        case _:
            return known == asked


def _is_known(state: State, condition: Condition) -> bool:
    if isinstance(condition, Not):
        return state.facts.get(condition.body) is False
    return state.facts.get(condition) is True


def _possible(
    state: State, relation: str, near: IndividualTerm, is_subject: bool
) -> Iterator[frozenset[IndividualTerm]]:
    group = state.possible.get((relation, near, is_subject))
    if group is not None:
        yield group


def _covers(types: AliasTypes, cls: str, relation: str, is_subject: bool) -> bool:
    """Whether all individuals on one side of a relation are of the class."""
    if cls == THING:
        return True
    term = types.vocabulary.relations.get(relation)
    if term is None or types.is_computed(relation):
        return False
    ends = [signature.domain if is_subject else signature.range for signature in term.signatures]
    return bool(ends) and all(types.vocabulary.is_a(end, cls) for end in ends)


def _push_negation(condition: Condition) -> Condition:
    """Return the condition with `not` pushed inwards as far as possible."""
    match condition:
        case Not(body=Not(body=body)):
            return _push_negation(body)
        case Not(body=And(parts=parts)):
            return Or(tuple(_push_negation(Not(part)) for part in parts))
        case Not(body=Or(parts=parts)):
            return And(tuple(_push_negation(Not(part)) for part in parts))
    return condition


def _negate(condition: Condition) -> Condition:
    return condition.body if isinstance(condition, Not) else Not(condition)


def _depths(condition: Condition) -> Iterator[int]:
    """Yield the numbers in the names of the quantifiers of a condition in normal form."""
    return (int(each.variable.removeprefix(BOUND_PREFIX)) for each in walk(condition) if isinstance(each, Exists))
