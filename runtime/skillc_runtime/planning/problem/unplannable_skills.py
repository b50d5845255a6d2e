"""Which of the skills that cannot be planned with might be of use, and which make no difference to any plan.

Follow back from the goal: what it reads, what the skills read that can help, what is computed from other facts. A skill
that changes none of this leaves all of it as it is, wherever it stands in a sequence of steps: without it the rest of
the sequence works as well.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Set

from skillc_compiler.library.conditions import Assert, Condition
from skillc_compiler.library.pddl.domain import Excluded
from skillc_compiler.library.pddl.effects import changed_terms
from skillc_compiler.library.pddl.relations import Relations
from skillc_compiler.library.reading import terms_read
from skillc_compiler.library.skills import Implementation, Skill, SkillLibrary


def select_skills_that_may_matter(
    excluded: Collection[Excluded], helpful: Iterable[str], goal: Condition, library: SkillLibrary
) -> frozenset[str]:
    """Return those excluded skills that might make a plan possible or cheaper; `helpful` are planned with."""
    relations = Relations(library.vocabulary)
    open_ = {each.skill for each in excluded if not each.impossible}
    changed = {name: changed_terms(library.skills[name].post, relations) for name in open_}
    needed = _Needed(library, relations)
    needed.add(terms_read(goal))
    for name in helpful:
        needed.add(_reads(library.skills[name], library, relations))
    found: set[str] = set()
    while more := {name for name in open_ - found if needed.meets(changed[name])}:
        found |= more
        for name in more:
            needed.add(_reads(library.skills[name], library, relations))
    return frozenset(found)


class _Needed:
    """Relations and properties, with all that decides what holds of them."""

    def __init__(self, library: SkillLibrary, relations: Relations) -> None:
        self._vocabulary, self._relations = library.vocabulary, relations
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
            below = {each.relation for each in self._relations.below(iri)} if self._is_relation(iri) else {iri}
            for each in below - self._terms:
                self._terms.add(each)
                todo.extend(self._deciding(each))

    def _is_relation(self, iri: str) -> bool:
        return iri in self._vocabulary.relations

    def _deciding(self, iri: str) -> tuple[str, ...]:
        term = self._vocabulary.relations.get(iri) or self._vocabulary.properties[iri]
        if term.computed_by is None:
            return ()
        known: tuple[str, ...] = getattr(term, "computed_from", ())
        self._everything |= not known
        return known


def _reads(skill: Skill, library: SkillLibrary, relations: Relations) -> Iterator[str]:
    """Yield what decides whether a skill can start, how long it takes, and whether its effects are allowed."""
    described: tuple[Skill | Implementation, ...] = (skill, *library.implementations_of(skill.name))
    for one in described:
        for requirement in (*one.pre, *one.hold):
            yield from terms_read(requirement.condition)
        if one.duration is not None:
            yield from terms_read(one.duration)
    for post in skill.post:
        yield from terms_read(post.condition)
        for effect in post.effects:
            above = relations.above(effect.relation) if isinstance(effect, Assert) else ()
            implied = (each.relation for each in above)
            yield from (iri for iri in implied if library.vocabulary.relations[iri].asymmetric)
