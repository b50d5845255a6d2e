"""Which facts may begin or end with one that is asserted or retracted, by the axioms of its relation."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.analysis.knowledge.alias_types import AliasTypes, Pattern, Triple, is_any_individual
from skillc_compiler.analysis.knowledge.state import State
from skillc_model.conditions import Anything, Holds, Term


def may_become_true(types: AliasTypes, fact: Triple) -> tuple[Pattern, ...]:
    """Return the facts that an assertion may make true."""
    subject, relation, object_ = fact
    return tuple(
        _in_chains(types, Pattern(*((object_, above, subject) if turned else (subject, above, object_))))
        for above, turned in types.axioms.implied.get(relation, ((relation, False),))
    )


def may_become_untrue(types: AliasTypes, fact: Triple, value: bool | None) -> tuple[Pattern, ...]:
    """Return the facts that an assertion, by replacing others, or a retraction may make untrue."""
    subject, relation, object_ = fact
    lost: list[Triple] = []
    if value is not True:
        lost += [
            (object_, source, subject) if turned else (subject, source, object_)
            for source, turned in types.axioms.sources.get(relation, ((relation, False),))
        ]
    if value is not False:
        lost += [each for true in may_become_true(types, fact) for each in _replaced_by(types, true)]
    return tuple(dict.fromkeys(pattern for each in lost for pattern in may_become_true(types, each)))


def _replaced_by(types: AliasTypes, fact: Pattern) -> Iterator[Triple]:
    """Yield the facts that end when this one begins, as its relation has one object or one subject."""
    axioms, relation = types.axioms, fact.relation
    subject, object_ = (Anything(), Anything()) if fact.is_link else (fact.subject, fact.object)
    for source, turned in axioms.sources.get(relation, ((relation, False),)):
        if relation in axioms.single_object:
            yield (Anything(), source, subject) if turned else (subject, source, Anything())
        if relation in axioms.single_subject:
            yield (object_, source, Anything()) if turned else (Anything(), source, object_)


def _in_chains(types: AliasTypes, pattern: Pattern) -> Pattern:
    """Return the pattern; if the relation may hold by a chain of facts, of those in which this one is a link.

    Of a relation that is not transitive itself, but above one that is, any fact may change.
    """
    if pattern.relation not in types.axioms.chained:
        return pattern
    if pattern.relation in types.axioms.transitive:
        return pattern._replace(is_link=True)
    return Pattern(Anything(), pattern.relation, Anything())


def matches(types: AliasTypes, state: State, fact: Holds, pattern: Pattern) -> bool:
    if fact.relation != pattern.relation:
        return False
    if pattern.is_link:
        return _may_lead_over(types, state, fact, pattern)
    return types.may_be_same(state, fact.subject, pattern.subject) and types.may_be_same(
        state, fact.object, pattern.object
    )


def _may_lead_over(types: AliasTypes, state: State, fact: Holds, link: Pattern) -> bool:
    """Whether a chain from the subject of a fact to its object may lead over a link.

    It gets to where the link begins, and from where it ends to the object. If no chain leads back to where it begins,
    none leads over a link that ends at its subject or begins at its object.
    """
    if link.relation in types.axioms.acyclic and (
        _is_one(fact.subject, link.object) or _is_one(fact.object, link.subject)
    ):
        return False
    return _may_lead_to(types, state, fact.subject, link.relation, link.subject) and _may_lead_to(
        types, state, link.object, link.relation, fact.object
    )


def _may_lead_to(types: AliasTypes, state: State, start: Term, relation: str, end: Term) -> bool:
    """Whether two terms may be the same, or a chain of a relation may lead from one to the other."""
    return types.may_be_same(state, start, end) or state.facts.get(Holds(start, relation, end)) is not False


def _is_one(one: Term, other: Term) -> bool:
    """Whether two terms are certainly the same individual."""
    return one == other and not isinstance(one, Anything) and not is_any_individual(one)
