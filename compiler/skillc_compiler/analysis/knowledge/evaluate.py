"""Whether a condition holds in a state: true, false, or None if what is known leaves it open."""

from __future__ import annotations

from collections.abc import Iterable
from typing import assert_never

from msgspec.structs import replace

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.canonical import canonical_condition
from skillc_compiler.analysis.knowledge.quantifiers import (
    implies,
    is_ruled_out,
    known_individuals,
    possible_witnesses,
)
from skillc_compiler.analysis.knowledge.state import IndividualTerm, State
from skillc_compiler.logic.bounds import Bound, are_disjoint, compare_constants
from skillc_model.conditions import (
    Aggregate,
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
from skillc_model.definitions import write_out
from skillc_model.rewriting import substitute_one


def evaluate(types: AliasTypes, state: State, condition: Condition) -> bool | None:
    """Return whether the condition holds in every world that agrees with the state; None if open."""
    return _evaluate(types, state, canonical_condition(types, state, condition))


def _evaluate(types: AliasTypes, state: State, condition: Condition) -> bool | None:
    match condition:
        case Holds():
            return _evaluate_relation(types, state, condition)
        case Not(body=body):
            inner = _evaluate(types, state, body)
            return None if inner is None else not inner
        case And(parts=parts):
            return _conjoin(state.facts.get(condition), [_evaluate(types, state, part) for part in parts])
        case Or(parts=parts):
            known = _look_up(types, state, condition)
            turned = _conjoin(
                None if known is None else not known, [_evaluate_negation(types, state, part) for part in parts]
            )
            return None if turned is None else not turned
        case Same(left=left, right=right):
            return _evaluate_same(types, state, left, right)
        case IsA(subject=Variable() | Individual() as subject, cls=cls):
            return types.is_a(state, subject, cls)
        case Compare():
            return _evaluate_comparison(types, state, condition)
        case HasProperty(subject=subject, property=iri):
            return (
                None
                if isinstance(subject, Anything)
                else _evaluate_has(types, state, condition, PropertyOf(subject, iri))
            )
        case Exists():
            return _evaluate_exists(types, state, condition)
        case Forall() | Given() | IsA():
            return state.facts.get(condition)
        case _:
            assert_never(condition)


def _evaluate_negation(types: AliasTypes, state: State, condition: Condition) -> bool | None:
    inner = _evaluate(types, state, condition)
    return None if inner is None else not inner


def _conjoin(known: bool | None, parts: Iterable[bool | None]) -> bool | None:
    found = list(parts)
    if False in found:
        return False
    return known if None in found else True


def _evaluate_same(types: AliasTypes, state: State, left: object, right: object) -> bool | None:
    if not isinstance(left, Variable | Individual) or not isinstance(right, Variable | Individual):
        return None
    if left == right:
        return True
    return False if types.are_distinct(state, left, right) else None


def _evaluate_relation(types: AliasTypes, state: State, asked: Holds) -> bool | None:
    known = state.facts.get(asked)
    if known is not None:
        return known
    if is_ruled_out(types, state, asked):
        return False
    if asked.relation in types.vocabulary.definitions:
        # Both the relation and the condition that defines it, in which it may occur, hold, or neither does.
        inner = replace(types, unfolds=types.unfolds - 1)
        return evaluate(inner, state, write_out(asked, types.vocabulary)) if types.unfolds else None
    match asked.subject, asked.object:
        case Anything(), Anything():
            return True if asked.relation in state.relations else None
        case Anything(), (Variable() | Individual()) as end:
            return _evaluate_related_to_any(state, asked.relation, end, False)
        case (Variable() | Individual()) as start, Anything():
            return _evaluate_related_to_any(state, asked.relation, start, True)
        case (Variable() | Individual()) as start, (Variable() | Individual()) as end:
            if _is_excluded(types, state, asked.relation, start, end):
                return False
            return True if _is_only_value(types, state, asked.relation, start, end) else None
    return None


def _is_only_value(types: AliasTypes, state: State, relation: str, start: IndividualTerm, end: IndividualTerm) -> bool:
    """Whether something is related to a value of an enumeration, since it is to one of them, and to no other one."""
    values = types.values_of(relation)
    if end not in values or not _evaluate_related_to_any(state, relation, start, True):
        return False
    return all(state.facts.get(Holds(start, relation, each)) is False for each in values if each != end)


def _evaluate_related_to_any(state: State, relation: str, thing: IndividualTerm, is_subject: bool) -> bool | None:
    known = state.relations.get(relation, ())
    if any((fact.subject if is_subject else fact.object) == thing for fact in known):
        return True
    others = state.possible.get((relation, thing, is_subject))
    if others is None:
        return None
    facts = (Holds(thing, relation, each) if is_subject else Holds(each, relation, thing) for each in others)
    return False if all(state.facts.get(fact) is False for fact in facts) else None


def _is_excluded(types: AliasTypes, state: State, relation: str, start: IndividualTerm, end: IndividualTerm) -> bool:
    """Whether the possible values of either side, or an axiom, rule out the relation between the two."""
    axioms = types.axioms
    if start == end and relation in axioms.irreflexive:
        return True
    if relation in axioms.asymmetric and state.facts.get(Holds(end, relation, start)):
        return True
    for side, other in (((relation, start, True), end), ((relation, end, False), start)):
        rest = state.possible.get(side)
        if rest is not None and all(types.are_distinct(state, other, each) for each in rest):
            return True
    for fact in state.relations.get(relation, ()):
        if relation in axioms.single_object and fact.subject == start and _are_distinct(types, state, fact.object, end):
            return True
        if (
            relation in axioms.single_subject
            and fact.object == end
            and _are_distinct(types, state, fact.subject, start)
        ):
            return True
    return False


def _are_distinct(types: AliasTypes, state: State, one: object, other: IndividualTerm) -> bool:
    return isinstance(one, Variable | Individual) and types.are_distinct(state, one, other)


def _look_up(types: AliasTypes, state: State, asked: Condition) -> bool | None:
    """Return whether an `or` or `exists` is known to hold or not, itself or by one that is known and implies it."""
    known = state.facts.get(asked)
    if known is not None:
        return known
    stronger = (fact for fact, true in state.facts.items() if true and type(fact) is type(asked))
    return True if any(implies(types, fact, asked) for fact in stronger) else None


def _evaluate_exists(types: AliasTypes, state: State, condition: Exists) -> bool | None:
    known = _look_up(types, state, condition)
    if known is not None:
        return known

    def of(thing: IndividualTerm) -> bool | None:
        return _evaluate(
            types, state, canonical_condition(types, state, substitute_one(condition.body, condition.variable, thing))
        )

    if any(types.is_a(state, thing, condition.cls) and of(thing) for thing in known_individuals(state)):
        return True
    return (
        False if any(all(of(one) is False for one in group) for group in possible_witnesses(state, condition)) else None
    )


def _evaluate_comparison(types: AliasTypes, state: State, asked: Compare) -> bool | None:
    known = state.facts.get(asked)
    if known is not None:
        return known
    if isinstance(asked.left, Literal) and isinstance(asked.right, Literal):
        return compare_constants(asked.operator, asked.left.value, asked.right.value)
    if is_ruled_out(types, state, asked):
        return False
    if asked.left == asked.right and isinstance(asked.left, Variable):
        return asked.operator in ("==", "<=", ">=")
    if _is_missing(state, asked.left):
        return False
    if isinstance(asked.left, Aggregate) and isinstance(asked.right, Literal) and _is_none(types, state, asked.left):
        return compare_constants(asked.operator, 0, asked.right.value)
    if not _is_single(types, asked.left):
        return None
    for fact, true in state.facts.items():
        if isinstance(fact, Compare) and fact.left == asked.left:
            answer = _infer_comparison(fact, true, asked)
            if answer is not None:
                return answer
    return None


def _is_none(types: AliasTypes, state: State, counted: Aggregate) -> bool:
    """Whether this is the number of individuals of which it is known that there are none."""
    some = Exists(counted.variable, counted.cls, counted.where)
    return counted.function == "count" and evaluate(types, state, some) is False


def _is_missing(state: State, value: Expression) -> bool:
    match value:
        case PropertyOf(of=Variable() | Individual() as of, property=iri):
            return state.facts.get(HasProperty(of, iri)) is False
    return False


def _is_single(types: AliasTypes, value: Expression) -> bool:
    """Whether the expression has one value; comparisons of a property with several values are independent."""
    if not isinstance(value, PropertyOf):
        return True
    term = types.vocabulary.properties.get(value.property)
    return term is not None and term.functional


def _evaluate_has(types: AliasTypes, state: State, asked: HasProperty, value: PropertyOf) -> bool | None:
    known = state.facts.get(asked)
    if known is not None:
        return known
    if is_ruled_out(types, state, asked):
        return False
    compared = (true and fact.left == value for fact, true in state.facts.items() if isinstance(fact, Compare))
    return True if any(compared) else None


def _infer_comparison(known: Compare, true: bool, asked: Compare) -> bool | None:
    """Return what one comparison of a value with a constant implies for another, or None."""
    if not isinstance(known.right, Literal) or not isinstance(asked.right, Literal) or not true:
        return None
    one = Bound(known.left, known.operator, known.right.value)
    other = Bound(asked.left, asked.operator, asked.right.value)
    if are_disjoint(one, other):
        return False
    return True if are_disjoint(one, other.opposite()) else None
