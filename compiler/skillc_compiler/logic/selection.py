"""The order in which implementations are tried, and whether two implementations can fit the same arguments."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence
from heapq import heapify, heappop, heappush
from typing import TypeAlias

from skillc_compiler.logic.bounds import Bound, are_disjoint
from skillc_compiler.logic.conflicts import Conflicts
from skillc_compiler.logic.conjunctions import TypedFact, facts_in
from skillc_compiler.program.expressions import TypedExpression
from skillc_compiler.program.typed import Implementation, Parameter
from skillc_compiler.program.types import Thing, Type, fits
from skillc_model.conditions import Condition, Literal
from skillc_model.rewriting import constant_number
from skillc_rdf.vocabulary.types import Vocabulary

_ANY = Literal(0.0)
_Types: TypeAlias = tuple[Type, ...]


def types_overlap(vocabulary: Vocabulary, one: Type, other: Type) -> bool:
    """Whether some value is of both types: for classes, whether the vocabulary has a common subclass."""
    if fits(vocabulary, one, other) or fits(vocabulary, other, one):
        return True
    match one, other:
        case Thing(cls=str(a)), Thing(cls=str(b)):
            return any(a in above and b in above for above in vocabulary.ancestors.values())
    return False


def can_both_fit(conflicts: Conflicts, one: Implementation, other: Implementation) -> bool:
    """Whether two implementations of a skill can fit the same arguments."""
    pairs = list(zip(one.parameters, other.parameters, strict=True))
    if not all(types_overlap(conflicts.vocabulary, a.type, b.type) and _ranges_overlap(a, b) for a, b in pairs):
        return False
    return not any(conflicts.exclude(a, b) for a in _added_facts(one) for b in _added_facts(other))


def subsumes(vocabulary: Vocabulary, one: Implementation, other: Implementation) -> bool:
    """Whether an implementation fits wherever the other does, because it requires no more."""
    pairs = zip(one.parameters, other.parameters, strict=True)
    return all(fits(vocabulary, b.type, a.type) and _range_contains(a, b) for a, b in pairs) and added_preconditions(
        one
    ) <= added_preconditions(other)


def added_preconditions(implementation: Implementation) -> frozenset[tuple[Condition, bool]]:
    """Return the preconditions that an implementation adds to its skill."""
    return frozenset((fact.meaning, fact.holds) for fact in _added_facts(implementation))


def _added_facts(implementation: Implementation) -> list[TypedFact]:
    return [f for r in implementation.requirements if r.kind == "pre" for f in facts_in(r.condition)]


def _ranges_overlap(one: Parameter, other: Parameter) -> bool:
    pairs = ((_low(one), _high(other)), (_low(other), _high(one)))
    return not any(low and high and are_disjoint(low, high) for low, high in pairs)


def _range_contains(wide: Parameter, narrow: Parameter) -> bool:
    """Whether the range of one parameter contains that of another."""
    ends = ((_low(wide), _low(narrow)), (_high(wide), _high(narrow)))
    return all(outer is None or (inner is not None and are_disjoint(inner, outer.opposite())) for outer, inner in ends)


def _low(parameter: Parameter) -> Bound | None:
    return _end(parameter.low, ">=")


def _high(parameter: Parameter) -> Bound | None:
    return _end(parameter.high, "<=")


def _end(value: TypedExpression | None, operator: str) -> Bound | None:
    known = constant_number(value.meaning) if value else None
    if known is None:
        return None
    return Bound(_ANY, ">=" if operator == ">=" else "<=", known)


def rank_implementations(vocabulary: Vocabulary, declared: Sequence[Implementation]) -> tuple[Implementation, ...]:
    """Return the implementations of one skill in rank order.

    Repeatedly, from those not yet ranked: those than which no other is more specific; of these the highest `prefer`,
    then the earliest declared. Those that unknown types make more specific than each other come last.
    """
    ranks = sorted((-each.prefer, number) for number, each in enumerate(declared))
    alike: dict[_Types, list[tuple[float, int]]] = defaultdict(list)
    for rank in reversed(ranks):
        alike[_types(declared[rank[1]])].append(rank)
    wider = {one: [other for other in alike if _are_narrower(vocabulary, one, other)] for one in alike}
    narrower = Counter(other for others in wider.values() for other in others)
    front = [left.pop() for types, left in alike.items() if not narrower[types]]
    heapify(front)
    order: dict[tuple[float, int], None] = {}
    while front:
        best = heappop(front)
        order[best] = None
        types = _types(declared[best[1]])
        narrower.subtract(() if alike[types] else wider[types])
        freed = [types] if alike[types] else [other for other in wider[types] if not narrower[other]]
        for each in freed:
            heappush(front, alike[each].pop())
    return tuple(declared[number] for _, number in (order | dict.fromkeys(ranks)))


def is_more_specific(vocabulary: Vocabulary, one: Implementation, other: Implementation) -> bool:
    """Whether each parameter type of `one` is at least as narrow as that of `other`, and at least one is narrower."""
    return _are_narrower(vocabulary, _types(one), _types(other))


def _types(implementation: Implementation) -> _Types:
    return tuple(each.type for each in implementation.parameters)


def _are_narrower(vocabulary: Vocabulary, one: _Types, other: _Types) -> bool:
    pairs = [(p, q) for p, q in zip(one, other, strict=True) if p != q]
    return all(fits(vocabulary, p, q) for p, q in pairs) and not all(fits(vocabulary, q, p) for p, q in pairs)
