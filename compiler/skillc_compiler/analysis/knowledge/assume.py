"""What becomes known when a condition is observed to hold, or not to hold."""

from __future__ import annotations

from collections.abc import Iterable

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes
from skillc_compiler.analysis.knowledge.axioms import CanonicalAxioms
from skillc_compiler.analysis.knowledge.canonical import canonical_condition
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.state import IndividualTerm, Side, State
from skillc_model.conditions import And, Anything, Condition, Holds, Individual, Not, Or, Same, Variable
from skillc_model.rewriting import substitute


def assume(types: AliasTypes, state: State, condition: Condition, holds: bool = True) -> State | None:
    """Return the state in which the condition also holds (or does not), or None if that contradicts what is known."""
    condition = canonical_condition(types, state, condition)
    known = evaluate(types, state, condition)
    if known is not None:
        return state if known is holds else None
    match condition:
        case Not(body=body):
            return assume(types, state, body, not holds)
        case And(parts=parts) if holds:
            return _assume_each(types, state, parts, True)
        case Or(parts=parts) if not holds:
            return _assume_each(types, state, parts, False)
        case And(parts=parts) | Or(parts=parts):
            return _assume_last_open(types, state, condition, parts, holds)
        case Holds():
            return _assume_relation(types, state, condition, holds)
        case Same(left=Variable() as left, right=Variable() | Individual() as right) if holds:
            return unify(state, left, right)
        case Same(left=Individual() as left, right=Variable() as right) if holds:
            return unify(state, right, left)
    return state.with_facts({condition: holds})


def unify(state: State, name: Variable, thing: IndividualTerm) -> State:
    """Return the state in which `name` is another name for `thing`."""
    values = {name.name: thing}
    facts = {substitute(fact, values): value for fact, value in state.facts.items()}
    alone = {
        (relation, thing if side == name else side, is_subject): frozenset(thing if o == name else o for o in others)
        for (relation, side, is_subject), others in state.possible.items()
    }
    same = {key: thing if other == name else other for key, other in state.aliases.items()}
    return state.replace(facts=facts, possible=alone, aliases={**same, **values})


def _assume_each(types: AliasTypes, state: State, parts: tuple[Condition, ...], holds: bool) -> State | None:
    current: State | None = state
    for part in parts:
        current = assume(types, current, part, holds) if current is not None else None
    return current


def _assume_last_open(
    types: AliasTypes, state: State, whole: Condition, parts: tuple[Condition, ...], holds: bool
) -> State | None:
    """Assume that at least one part is as `holds` says: if all others are known not to be, the last one is."""
    open_ = [part for part in parts if evaluate(types, state, part) is None]
    if len(open_) == 1:
        return assume(types, state, open_[0], holds)
    return state.with_facts({whole: holds})


def _assume_relation(types: AliasTypes, state: State, fact: Holds, holds: bool) -> State:
    axioms = types.axioms
    if isinstance(fact.subject, Anything) or isinstance(fact.object, Anything):
        return _assume_related_to_any(types, state, fact, holds)
    reached = axioms.implied if holds else axioms.sources
    found: dict[Condition, bool] = {}
    for relation, turned in reached.get(fact.relation, ((fact.relation, False),)):
        if turned:
            found[Holds(fact.object, relation, fact.subject)] = holds
        else:
            found[Holds(fact.subject, relation, fact.object)] = holds
    alone = single_values(axioms, found) if holds else {}
    return state.replace(facts={**state.facts, **found}, possible={**state.possible, **alone})


def single_values(axioms: CanonicalAxioms, facts: Iterable[Condition]) -> dict[Side, frozenset[IndividualTerm]]:
    """Return the only individuals on the sides of single-valued relations, given that these facts hold."""
    alone: dict[Side, frozenset[IndividualTerm]] = {}
    for fact in facts:
        match fact:
            case Holds(Variable() | Individual() as start, above, Variable() | Individual() as end):
                for source, turned in axioms.sources.get(above, ((above, False),)):
                    if above in axioms.single_object:
                        alone[(source, start, not turned)] = frozenset({end})
                    if above in axioms.single_subject:
                        alone[(source, end, turned)] = frozenset({start})
    return alone


def _assume_related_to_any(types: AliasTypes, state: State, fact: Holds, holds: bool) -> State:
    thing, is_subject = (fact.object, False) if isinstance(fact.subject, Anything) else (fact.subject, True)
    if holds or isinstance(thing, Anything):
        return state.with_facts({fact: holds})
    sources = types.axioms.sources.get(fact.relation, ((fact.relation, False),))
    none = {(relation, thing, is_subject != turned): frozenset[IndividualTerm]() for relation, turned in sources}
    return state.replace(possible={**state.possible, **none})
