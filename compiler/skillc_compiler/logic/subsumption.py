"""Which values parameters of implementations take, and whether two implementations can both fit."""

from __future__ import annotations

from skillc_compiler.logic.bounds import Bound, are_disjoint
from skillc_compiler.logic.conflicts import Conflicts
from skillc_compiler.logic.conjunctions import Fact, conjuncts
from skillc_compiler.program.typed import Implementation, Parameter, TypedExpression
from skillc_compiler.program.types import Thing, Type, fits
from skillc_model.conditions import Condition, Literal
from skillc_model.rewriting import constant_number
from skillc_rdf.vocabulary.types import Vocabulary

_ANY = Literal(0.0)


def overlap(vocabulary: Vocabulary, one: Type, other: Type) -> bool:
    """Whether some value is of both types: for classes, whether a class of the vocabulary is below both."""
    if fits(vocabulary, one, other) or fits(vocabulary, other, one):
        return True
    match one, other:
        case Thing(cls=str(a)), Thing(cls=str(b)):
            return any(a in above and b in above for above in vocabulary.ancestors.values())
    return False


def both_fit(conflicts: Conflicts, one: Implementation, other: Implementation) -> bool:
    """Whether the same arguments may suit two implementations of a skill."""
    pairs = list(zip(one.parameters, other.parameters, strict=True))
    if not all(overlap(conflicts.vocabulary, a.type, b.type) and _ranges_meet(a, b) for a, b in pairs):
        return False
    return not any(conflicts.between(a, b) for a in _own(one) for b in _own(other))


def subsumes(vocabulary: Vocabulary, one: Implementation, other: Implementation) -> bool:
    """Whether an implementation fits wherever the other does: it asks for no more."""
    pairs = zip(one.parameters, other.parameters, strict=True)
    return all(fits(vocabulary, b.type, a.type) and _range_holds(a, b) for a, b in pairs) and asks(one) <= asks(other)


def asks(implementation: Implementation) -> frozenset[tuple[Condition, bool]]:
    """Return what an implementation adds to the preconditions of its skill."""
    return frozenset((fact.meaning, fact.holds) for fact in _own(implementation))


def _own(implementation: Implementation) -> list[Fact]:
    return [f for r in implementation.requirements if r.kind == "pre" for f in conjuncts(r.clause)]


def _ranges_meet(one: Parameter, other: Parameter) -> bool:
    pairs = ((_low(one), _high(other)), (_low(other), _high(one)))
    return not any(low and high and are_disjoint(low, high) for low, high in pairs)


def _range_holds(wide: Parameter, narrow: Parameter) -> bool:
    """Whether all values in the range of one parameter are in that of another."""
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
