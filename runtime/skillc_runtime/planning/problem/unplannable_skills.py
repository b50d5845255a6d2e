"""Which of the skills that cannot be planned with might be of use, and which make no difference to any plan.

Follow back from the goal: what it reads, what the skills read that can help, what is computed from other facts. A skill
that changes none of this leaves all of it as it is, wherever it stands in a sequence of steps: without it the rest of
the sequence works as well.
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
    """Return those excluded skills that might make a plan possible or cheaper; `helpful` are planned with."""
    open_ = {each.skill for each in excluded if not each.impossible}
    changed = {name: terms_written(library.skills[name].post, library.vocabulary) for name in open_}
    needed = _Needed(library.vocabulary)
    needed.add(terms_read(goal))
    for name in helpful:
        needed.add(terms_read_by(library.skills[name], library))
    found: set[str] = set()
    while more := {name for name in open_ - found if needed.meets(changed[name])}:
        found |= more
        for name in more:
            needed.add(terms_read_by(library.skills[name], library))
    return frozenset(found)


class _Needed:
    """Relations and properties, with all that decides what holds of them."""

    def __init__(self, vocabulary: Vocabulary) -> None:
        self._vocabulary = vocabulary
        self._terms: set[str] = set()
        self._everything = False

    def meets(self, changed: Set[str]) -> bool:
        """Whether one of these is needed."""
        return bool(changed) if self._everything else not self._terms.isdisjoint(changed)

    def add(self, terms: Iterable[str]) -> None:
        """Take in these and what decides them; where nobody knows what does, everything may."""
        todo = list(terms)
        while todo:
            iri = todo.pop()
            below = self._vocabulary.closure.canonical_sources.get(iri)
            for each in ({iri} if below is None else {each.relation for each in below}) - self._terms:
                self._terms.add(each)
                todo.extend(self._deciding(each))

    def _deciding(self, iri: str) -> tuple[str, ...]:
        term = self._vocabulary.relations.get(iri) or self._vocabulary.properties[iri]
        if term.computed_by is None:
            return ()
        known: tuple[str, ...] = getattr(term, "computed_from", ())
        self._everything |= not known
        return known
