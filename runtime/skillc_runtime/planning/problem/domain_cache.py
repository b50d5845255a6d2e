"""Caches planning domains: tasks in similar scenes, and plans for the same task, need the same one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

from skillc_model.pddl.constants import find_mentions
from skillc_model.pddl.domain import PlanningDomain
from skillc_model.pddl.planning import make_planning_domain
from skillc_model.skills import SkillLibrary

CACHE_SIZE = 4


def get_planning_domain(
    library: SkillLibrary, combined: frozenset[frozenset[str]], classes: Callable[[str], frozenset[str]]
) -> PlanningDomain:
    """Return the library as a planning domain, as `make_planning_domain` does.

    `classes` returns the most specific classes of an individual; empty if the scene does not have it.
    """
    key = _LibraryKey(library)
    known = {iri: classes(iri) for iri in _mentioned_individuals(key)}
    return _domain(key, combined, frozenset((iri, found) for iri, found in known.items() if found))


@dataclass(frozen=True, eq=False, slots=True)
class _LibraryKey:
    """A library as a cache key: equal if it has the same skills and an equal vocabulary."""

    library: SkillLibrary

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _LibraryKey):
            return NotImplemented
        one, two = self.library, other.library
        same = one.name == two.name and one.skills is two.skills and one.implementations is two.implementations
        return same and one.names == two.names and one.vocabulary == two.vocabulary

    def __hash__(self) -> int:
        return hash((id(self.library.skills), id(self.library.implementations)))


@lru_cache(CACHE_SIZE)
def _mentioned_individuals(key: _LibraryKey) -> frozenset[str]:
    return frozenset(each.individual for found in find_mentions(key.library).values() for each in found)


@lru_cache(CACHE_SIZE)
def _domain(
    key: _LibraryKey, combined: frozenset[frozenset[str]], individuals: frozenset[tuple[str, frozenset[str]]]
) -> PlanningDomain:
    return make_planning_domain(key.library, combined, dict(individuals))
