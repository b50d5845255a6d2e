"""What no individual fulfils: none does after a write either, if what is written does not and no other one notices."""

from __future__ import annotations

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes, is_any_individual, same_individual
from skillc_compiler.analysis.knowledge.canonical import canonical_condition
from skillc_compiler.analysis.knowledge.evaluate import evaluate
from skillc_compiler.analysis.knowledge.havoc import OTHER, havoc
from skillc_compiler.analysis.knowledge.state import IndividualTerm, State
from skillc_compiler.analysis.knowledge.writes import PropertyWrite, RelationWrite, Write
from skillc_model.conditions import Condition, Exists, Individual, IsA, Same, Variable
from skillc_model.rewriting import substitute


def keep_denied(types: AliasTypes, before: State, after: State, write: Write) -> State:
    """Return the state after a write with every denied `exists` that the write has left as it was."""
    denied = (fact for fact, true in before.facts.items() if not true and isinstance(fact, Exists))
    lost = [fact for fact in denied if fact not in after.facts and _is_kept(types, before, after, fact, write)]
    return after.with_facts(dict.fromkeys(lost, False)) if lost else after


def _is_kept(types: AliasTypes, before: State, after: State, fact: Exists, write: Write) -> bool:
    if not isinstance(write, RelationWrite | PropertyWrite):
        return False
    written = _written(before, write)
    candidates = [thing for thing in written if types.is_a(after, thing, fact.cls) is not False]
    fulfilled = (evaluate(types, after, substitute(fact.body, {fact.variable: thing})) for thing in candidates)
    return (
        bool(written)
        and all(each is False for each in fulfilled)
        and not _is_noticed(types, before, fact, write, written)
    )


def _written(state: State, write: RelationWrite | PropertyWrite) -> tuple[IndividualTerm, ...]:
    """Return the individuals that a write is about; none if it may be about any."""
    ends = (write.subject, write.object) if isinstance(write, RelationWrite) else (write.subject,)
    named = [substitute(end, state.aliases) for end in ends if isinstance(end, Variable | Individual)]
    return () if len(named) < len(ends) or any(map(is_any_individual, named)) else tuple(named)


def _is_noticed(
    types: AliasTypes, state: State, fact: Exists, write: Write, written: tuple[IndividualTerm, ...]
) -> bool:
    """Whether the write may change for any other individual whether it fulfils the condition."""
    other = Variable(OTHER)
    types.classes[OTHER] = fact.cls
    body = canonical_condition(types, state, substitute(fact.body, {fact.variable: other}))
    known: dict[Condition, bool] = {each: true for each, true in state.facts.items() if isinstance(each, Same | IsA)}
    apart: dict[Condition, bool] = {same_individual(other, thing): False for thing in written}
    return body not in havoc(types, State({**known, **apart, body: False}), (write,)).facts
