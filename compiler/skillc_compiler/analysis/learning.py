"""What becomes known when a condition is seen to hold, or not to hold."""

from __future__ import annotations

from collections.abc import Iterable

from skillc_compiler.analysis.axioms import Axioms
from skillc_compiler.analysis.sorts import Sorts
from skillc_compiler.analysis.state import Side, State, Thing
from skillc_compiler.analysis.truth import canonical, truth
from skillc_model.conditions import And, Anything, Condition, Holds, Individual, Not, Or, Same, Variable
from skillc_model.rewriting import substitute


def learned(sorts: Sorts, state: State, condition: Condition, holds: bool = True) -> State | None:
    """Return the state in which it is known besides; None where it contradicts what is known."""
    condition = canonical(sorts, state, condition)
    known = truth(sorts, state, condition)
    if known is not None:
        return state if known is holds else None
    match condition:
        case Not(body=body):
            return learned(sorts, state, body, not holds)
        case And(parts=parts) if holds:
            return _each(sorts, state, parts, True)
        case Or(parts=parts) if not holds:
            return _each(sorts, state, parts, False)
        case And(parts=parts) | Or(parts=parts):
            return _last(sorts, state, condition, parts, holds)
        case Holds():
            return _related(sorts, state, condition, holds)
        case Same(left=Variable() as left, right=Variable() | Individual() as right) if holds:
            return merged(state, left, right)
        case Same(left=Individual() as left, right=Variable() as right) if holds:
            return merged(state, right, left)
    return state.having({condition: holds})


def merged(state: State, name: Variable, thing: Thing) -> State:
    """Return the state in which `name` is another name for `thing`."""
    values = {name.name: thing}
    facts = {substitute(fact, values): value for fact, value in state.facts.items()}
    alone = {
        (relation, thing if side == name else side, is_subject): frozenset(thing if o == name else o for o in others)
        for (relation, side, is_subject), others in state.alone.items()
    }
    same = {key: thing if other == name else other for key, other in state.same.items()}
    return state.replaced(facts=facts, alone=alone, same={**same, **values})


def _each(sorts: Sorts, state: State, parts: tuple[Condition, ...], holds: bool) -> State | None:
    current: State | None = state
    for part in parts:
        current = learned(sorts, current, part, holds) if current is not None else None
    return current


def _last(sorts: Sorts, state: State, whole: Condition, parts: tuple[Condition, ...], holds: bool) -> State | None:
    """Of parts one of which must be as `holds` says, all but one being the other way, learn that one."""
    open_ = [part for part in parts if truth(sorts, state, part) is None]
    if len(open_) == 1:
        return learned(sorts, state, open_[0], holds)
    return state.having({whole: holds})


def _related(sorts: Sorts, state: State, fact: Holds, holds: bool) -> State:
    axioms = sorts.axioms
    if isinstance(fact.subject, Anything) or isinstance(fact.object, Anything):
        return _related_to_any(sorts, state, fact, holds)
    reached = axioms.implied if holds else axioms.sources
    found: dict[Condition, bool] = {}
    for relation, turned in reached.get(fact.relation, ((fact.relation, False),)):
        if turned:
            found[Holds(fact.object, relation, fact.subject)] = holds
        else:
            found[Holds(fact.subject, relation, fact.object)] = holds
    alone = single_sides(axioms, found) if holds else {}
    return state.replaced(facts={**state.facts, **found}, alone={**state.alone, **alone})


def single_sides(axioms: Axioms, facts: Iterable[Condition]) -> dict[Side, frozenset[Thing]]:
    """Return who alone may stand on the sides of relations that have one value only, where these facts hold."""
    alone: dict[Side, frozenset[Thing]] = {}
    for fact in facts:
        match fact:
            case Holds(Variable() | Individual() as start, above, Variable() | Individual() as end):
                for source, turned in axioms.sources.get(above, ((above, False),)):
                    if above in axioms.single_object:
                        alone[(source, start, not turned)] = frozenset({end})
                    if above in axioms.single_subject:
                        alone[(source, end, turned)] = frozenset({start})
    return alone


def _related_to_any(sorts: Sorts, state: State, fact: Holds, holds: bool) -> State:
    thing, is_subject = (fact.object, False) if isinstance(fact.subject, Anything) else (fact.subject, True)
    if holds or isinstance(thing, Anything):
        return state.having({fact: holds})
    sources = sorts.axioms.sources.get(fact.relation, ((fact.relation, False),))
    none = {(relation, thing, is_subject != turned): frozenset[Thing]() for relation, turned in sources}
    return state.replaced(alone={**state.alone, **none})
