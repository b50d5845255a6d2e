"""The individuals that skills name, as constants of a planning domain."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import msgspec

from skillc_dsl.position import Position
from skillc_model.conditions import Adjust, Assert, Assign, HasProperty, Holds, Individual, PropertyOf, Retract
from skillc_model.pddl.hierarchy import find_common_class
from skillc_model.skills import Implementation, Parameter, Skill, SkillLibrary
from skillc_model.traversal import walk
from skillc_rdf.vocabulary.types import ClassType, Vocabulary


class Mention(msgspec.Struct, frozen=True):
    """An individual that a skill names, with the place in the source and the class required there (None: any)."""

    individual: str
    source: Position
    cls: str | None


def find_mentions(library: SkillLibrary) -> dict[str, tuple[Mention, ...]]:
    """Return the individuals named by each skill that is used in plans, its implementations included.

    A library with errors may use terms that are not in its vocabulary; these require no class.
    """
    return {
        name: mentions_of(skill, library.implementations_of(name), library.vocabulary)
        for name, skill in sorted(library.skills.items())
        if skill.planned
    }


def mentions_of(skill: Skill, implementations: Iterable[Implementation], vocabulary: Vocabulary) -> tuple[Mention, ...]:
    """Return the individuals that a skill and all its `implementations` name."""
    return tuple(_Mentions(vocabulary).of(skill, implementations))


def assumed_classes(found: Iterable[Mention], vocabulary: Vocabulary) -> dict[str, frozenset[str]]:
    """Return the classes required of individuals where skills name them, which is all that is known without a scene."""
    asked: dict[str, set[str]] = {}
    for each in found:
        asked.setdefault(each.individual, set()).update(() if each.cls is None else (each.cls,))
    return {iri: most_specific(classes, vocabulary) for iri, classes in asked.items()}


def most_specific(classes: Iterable[str], vocabulary: Vocabulary) -> frozenset[str]:
    """Return the classes that are not superclasses of any other."""
    known = frozenset(classes)
    if len(known) == 1:
        return known
    return frozenset(cls for cls in known if not any(each != cls and vocabulary.is_a(each, cls) for each in known))


class _Mentions(msgspec.Struct, frozen=True):
    vocabulary: Vocabulary

    def of(self, skill: Skill, implementations: Iterable[Implementation]) -> Iterator[Mention]:
        """Yield the individuals that a skill names in its conditions, postconditions, defaults and durations."""
        for result in skill.results:
            yield from self._inside((result.condition, *result.effects), result.source)
        described: tuple[Skill | Implementation, ...] = (skill, *implementations)
        for each in described:
            if each.duration is not None:
                yield from self._inside((each.duration,), each.source)
            for requirement in (*each.pre, *each.hold):
                yield from self._inside((requirement.condition,), requirement.source)
            yield from self._defaults(each.parameters)

    def _defaults(self, parameters: Iterable[Parameter]) -> Iterator[Mention]:
        for each in parameters:
            if isinstance(each.default, Individual) and isinstance(each.type, ClassType):
                yield Mention(each.default.iri, each.source, each.type.iri)

    def _inside(self, items: Iterable[msgspec.Struct], source: Position) -> Iterator[Mention]:
        for item in items:
            for part in walk(item):
                for individual, cls in self._asked(part):
                    yield Mention(individual, source, cls)

    def _asked(self, part: msgspec.Struct) -> Iterator[tuple[str, str | None]]:
        match part:
            case Individual(iri):
                yield iri, None
            case Holds(subject, relation, object_) | Assert(subject, relation, object_):
                yield from self._sides(relation, subject, object_)
            case Retract(subject, relation, object_):
                yield from self._sides(relation, subject, object_)
            case PropertyOf(Individual(iri), property_) | HasProperty(Individual(iri), property_):
                yield iri, self._owner(property_)
            case Assign(Individual(iri), property_, _) | Adjust(Individual(iri), property_, _, _):
                yield iri, self._owner(property_)

    def _sides(self, relation: str, *terms: object) -> Iterator[tuple[str, str | None]]:
        known = self.vocabulary.relations.get(relation)
        signatures = known.signatures if known is not None else ()
        for side, term in enumerate(terms):
            if isinstance(term, Individual) and signatures:
                yield (
                    term.iri,
                    find_common_class([(each.domain, each.range)[side] for each in signatures], self.vocabulary),
                )

    def _owner(self, property_: str) -> str | None:
        known = self.vocabulary.properties.get(property_)
        return find_common_class(known.domains, self.vocabulary) if known is not None and known.domains else None


def missing_individuals(found: Iterable[Mention], known: Mapping[str, object]) -> Iterator[Mention]:
    """Yield the first mention of each individual that is not known."""
    reported: set[str] = set()
    for each in found:
        if each.individual not in known and each.individual not in reported:
            reported.add(each.individual)
            yield each
