"""Poses conditions on relations that a library defines for planners: see `skillc_model.definitions`."""

from __future__ import annotations

from functools import lru_cache

from skillc_model.conditions import Condition
from skillc_model.counting import write_out_changing_counts, write_out_counts
from skillc_model.definitions import Expansion, expand_library, find_changing, passes_on
from skillc_model.read_write import terms_read
from skillc_model.skills import Implementation, Skill, SkillLibrary
from skillc_rdf.vocabulary.types import Definition
from skillc_runtime.planning.plan import LeftOut
from skillc_runtime.planning.stated_facts import LibraryKey
from skillc_runtime.world.state.world_state import WorldState

MOST_STEPS = 3
"""How many facts that skills change a chain may have at most; longer ones are not planned with."""

LONG_CHAINS = LeftOut(
    ("longer chains",), f"what follows from more than {MOST_STEPS} facts that skills change", False, kind="chains"
)


def expand_definitions(
    library: SkillLibrary, state: WorldState, goal: Condition
) -> tuple[SkillLibrary, Condition, tuple[LeftOut, ...]]:
    """Return a library and a goal that read no defined relation which skills change, and what is left out of them.

    Nor do they compare small numbers of individuals.
    """
    library, goal = _write_out_counts(LibraryKey(library)), write_out_counts(goal)
    changing = _find_changing(LibraryKey(library))
    if not changing:
        return library, goal, ()
    needed = {iri: _times_needed(iri, each, state) for iri, each in changing.items() if each.group}
    times = tuple((iri, min(often, MOST_STEPS)) for iri, often in sorted(needed.items()))
    exact = frozenset(iri for iri, often in times if often == needed[iri])
    expansion = Expansion(changing, dict(times), exact, library.vocabulary)
    read = terms_read(goal).union(*_terms_read(LibraryKey(library)))
    cut = any(often > MOST_STEPS for iri, often in needed.items() if _is_read(iri, read, changing))
    return _expand_library(LibraryKey(library), times, exact), expansion.of(goal), (LONG_CHAINS,) if cut else ()


def _times_needed(iri: str, definition: Definition, state: WorldState) -> int:
    """Return how often a definition leads back to itself at most until it asks again for what was asked before."""
    (signature,) = state.vocabulary.relations[iri].signatures
    subjects, objects = len(state.instances(signature.domain)), len(state.instances(signature.range))
    if passes_on(definition, definition.object):
        return subjects
    if passes_on(definition, definition.subject):
        return objects
    return len(definition.group) * subjects * objects


def _is_read(iri: str, read: frozenset[str], changing: dict[str, Definition]) -> bool:
    """Whether a relation is read, directly or by a definition."""
    reading, before = read, frozenset[str]()
    while reading != before:
        before = reading
        reading = reading.union(*(terms_read(changing[each].condition) for each in reading & changing.keys()))
    return iri in reading


@lru_cache(maxsize=16)
def _write_out_counts(key: LibraryKey) -> SkillLibrary:
    return write_out_changing_counts(key.library)


@lru_cache(maxsize=64)
def _find_changing(key: LibraryKey) -> dict[str, Definition]:
    return find_changing(key.library)


@lru_cache(maxsize=64)
def _terms_read(key: LibraryKey) -> tuple[frozenset[str], ...]:
    skills, implementations = key.library.skills, key.library.implementations
    planned = (each for each in skills.values() if each.planned)
    described: tuple[Skill | Implementation, ...] = (*planned, *implementations.values())
    return tuple(terms_read(one.condition) for each in described for one in (*each.pre, *each.hold))


@lru_cache(maxsize=16)
def _expand_library(key: LibraryKey, times: tuple[tuple[str, int], ...], exact: frozenset[str]) -> SkillLibrary:
    library = key.library
    return expand_library(library, Expansion(_find_changing(key), dict(times), exact, library.vocabulary))
