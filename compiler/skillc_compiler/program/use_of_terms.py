"""Notes in a vocabulary which of its relations and properties skills read, and which they change."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping

from msgspec import structs

from skillc_compiler.program.expressions import TypedCondition
from skillc_compiler.program.typed import Skill
from skillc_model.read_write import may_change, terms_read, unique_sides
from skillc_rdf.vocabulary.terms import with_named
from skillc_rdf.vocabulary.types import Vocabulary


def with_use(vocabulary: Vocabulary, named: Collection[str], skills: Mapping[str, Skill]) -> Vocabulary:
    """Return the vocabulary with what is known of the use of its terms; `named` are those in any text.

    What skills change is noted if there are rules, by which facts are derived that are to last.
    """
    vocabulary = with_named(vocabulary, named)
    return structs.replace(vocabulary, changing=_find_changing(skills, vocabulary)) if vocabulary.rules else vocabulary


def _find_changing(skills: Mapping[str, Skill], vocabulary: Vocabulary) -> tuple[str, ...]:
    """Return the relations and properties that what comes of a skill names, or that change with such a one, sorted."""
    conditions = (each.condition for skill in skills.values() for each in skill.requirements if each.says_what_comes)
    named = {term for condition in conditions for term in _list_terms(condition)}
    written = frozenset(_list_written(named, vocabulary))
    terms = (*vocabulary.relations, *vocabulary.properties)
    return tuple(sorted(each for each in terms if may_change(each, written, vocabulary)))


def _list_terms(condition: TypedCondition) -> Iterator[str]:
    yield from terms_read(condition.meaning)
    if condition.change is not None:
        yield from terms_read(condition.change.of.meaning)
    for part in condition.parts:
        yield from _list_terms(part)


def _list_written(named: Iterable[str], vocabulary: Vocabulary) -> Iterator[str]:
    """Yield the canonical relations, and the properties, that assertions and retractions of these may write."""
    closure = vocabulary.closure
    for term in named:
        if term not in vocabulary.relations:
            yield term
            continue
        for above in (term, *(each.relation for each in unique_sides(term, vocabulary))):
            yield from (each.relation for each in closure.canonical_sources.get(above, ()))
