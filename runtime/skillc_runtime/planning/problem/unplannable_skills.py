"""Decides which of the skills that planners cannot use may matter to a plan.

Starting from the goal, collect the terms that it reads, the terms that the helpful skills read, and the terms that
these are computed from. A skill that changes none of them can be removed from any sequence of steps: the rest of the
sequence still works.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Set

from skillc_model.conditions import Condition
from skillc_model.pddl.domain import Excluded
from skillc_model.read_write import terms_read, terms_read_by, terms_written
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.types import Vocabulary


def select_skills_that_may_matter(
    excluded: Collection[Excluded], helpful: Iterable[str], goal: Condition, library: SkillLibrary
) -> frozenset[str]:
    """Return the excluded skills that may make a plan possible or cheaper; `helpful` are the skills of the domain."""
    possible = {each.skill for each in excluded if not each.impossible}
    changed = {name: terms_written(library.skills[name].results, library.vocabulary) for name in possible}
    needed = _NeededTerms(library.vocabulary)
    needed.add(terms_read(goal))
    for name in helpful:
        needed.add(terms_read_by(library.skills[name], library))
    found: set[str] = set()
    while more := {name for name in possible - found if needed.is_any_needed(changed[name])}:
        found |= more
        for name in more:
            needed.add(terms_read_by(library.skills[name], library))
    return frozenset(found)


class _NeededTerms:
    """The needed relations and properties, closed under what they are derived and computed from."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary
        self._terms: set[str] = set()
        self._everything = False

    def is_any_needed(self, changed: Set[str]) -> bool:
        """Whether one of these terms is needed."""
        return bool(changed) if self._everything else not self._terms.isdisjoint(changed)

    def add(self, terms: Iterable[str]) -> None:
        """Add terms and what they depend on; if that is unknown, every term is needed from then on."""
        open_terms = list(terms)
        while open_terms:
            iri = open_terms.pop()
            below = self._vocabulary.closure.canonical_sources.get(iri)
            for each in ({iri} if below is None else {each.relation for each in below}) - self._terms:
                self._terms.add(each)
                open_terms.extend(self._dependencies(each))

    def _dependencies(self, iri: str) -> tuple[str, ...]:
        term = self._vocabulary.relations.get(iri) or self._vocabulary.properties[iri]
        if term.computed_by is None:
            return ()
        known: tuple[str, ...] = getattr(term, "computed_from", ())
        self._everything |= not known
        return known
