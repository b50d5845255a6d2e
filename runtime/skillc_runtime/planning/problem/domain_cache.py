"""Planning domains, remembered: tasks in like scenes, and plans that are made anew, need the same one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

from skillc_model.pddl.constants import mentions
from skillc_model.pddl.domain import PlanningDomain
from skillc_model.pddl.planning import planning_domain
from skillc_model.skills import SkillLibrary

REMEMBERED = 4


def get_planning_domain(
    library: SkillLibrary, combined: frozenset[frozenset[str]], classes: Callable[[str], frozenset[str]]
) -> PlanningDomain:
    """Return the library as a planning domain, as `planning_domain` does.

    `classes` are the lowest classes of an individual of the scene, none for one that the scene lacks.
    """
    skills = _Skills(library)
    known = {iri: classes(iri) for iri in _named(skills)}
    return _domain(skills, combined, frozenset((iri, found) for iri, found in known.items() if found))


@dataclass(frozen=True, eq=False, slots=True)
class _Skills:
    """A library as a key: the same skills, in a vocabulary that says the same."""

    library: SkillLibrary

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, _Skills):
            return NotImplemented
        one, two = self.library, other.library
        same = one.name == two.name and one.skills is two.skills and one.implementations is two.implementations
        return same and one.names == two.names and one.vocabulary == two.vocabulary

    def __hash__(self) -> int:
        return hash((id(self.library.skills), id(self.library.implementations)))


@lru_cache(REMEMBERED)
def _named(skills: _Skills) -> frozenset[str]:
    return frozenset(each.individual for found in mentions(skills.library).values() for each in found)


@lru_cache(REMEMBERED)
def _domain(
    skills: _Skills, combined: frozenset[frozenset[str]], individuals: frozenset[tuple[str, frozenset[str]]]
) -> PlanningDomain:
    return planning_domain(skills.library, combined, dict(individuals))
