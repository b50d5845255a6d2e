"""Foresees what rests on what, and what blocks it: planners get it as facts, which the world computes.

What a plan promises in this way is computed again from the poses that a look in space, or a run, finds.
"""

from __future__ import annotations

from functools import lru_cache

from skillc_model.conditions import Condition, Holds, Individual
from skillc_model.foresight import (
    BLOCKS,
    FORESEEN,
    RESTS_ON,
    computes_foreseen,
    find_terms_of_skills,
    state_foreseen,
    with_foreseen_effects,
)
from skillc_model.read_write import terms_read
from skillc_model.skills import SkillLibrary
from skillc_model.traversal import walk
from skillc_runtime.planning.stated_facts import LibraryKey, StatedTerms, VocabularyKey
from skillc_runtime.world.state.terms import OBJECT, SIZE
from skillc_runtime.world.state.versioned import PairIndex, PairIndexBuilder
from skillc_runtime.world.state.world_state import WorldState

HAND_M = 0.2
"""How near to a thing another one is that may leave no room for a hand around it."""


def foresee(library: SkillLibrary, state: WorldState, goal: Condition | None = None) -> tuple[SkillLibrary, WorldState]:
    """Return a library and a world for planners: with stated relations instead of computed ones that steps change.

    They are those that were given if neither the goal nor a skill reads or claims such a relation, or if they were
    foreseen before. Every plan of them is a plan for these.
    """
    if not computes_foreseen(state.vocabulary):
        return library, state
    concerned = _terms_of_skills(LibraryKey(library)) | (terms_read(goal) if goal is not None else frozenset())
    if concerned.isdisjoint(FORESEEN):
        return library, state
    stated = _state_relations(VocabularyKey(state.vocabulary))
    return _with_effects(LibraryKey(library), stated), _with_facts(state, stated)


def explain_unsupported(goal: Condition, state: WorldState) -> str | None:
    """Return that a goal names something on which nothing can rest, as it has no size; None if it names no such."""
    for each in walk(goal):
        match each:
            case Holds(relation=relation, object=Individual(iri)) if relation == RESTS_ON and state.exists(iri):
                if all(state.value(iri, name) is None for name in SIZE):
                    short = state.vocabulary.short(iri)
                    return f"{short} has no size, so nothing rests on it: name a thing there, or state {short}'s size"
    return None


@lru_cache(maxsize=4)
def _terms_of_skills(key: LibraryKey) -> frozenset[str]:
    return find_terms_of_skills(key.library)


@lru_cache(maxsize=4)
def _state_relations(key: VocabularyKey) -> StatedTerms:
    return StatedTerms.of(state_foreseen(key.vocabulary))


@lru_cache(maxsize=4)
def _with_effects(key: LibraryKey, stated: StatedTerms) -> SkillLibrary:
    return with_foreseen_effects(key.library, stated.vocabulary)


def _with_facts(state: WorldState, stated: StatedTerms) -> WorldState:
    """Return the world in which relations are stated that it computes, as they hold."""
    # Whoever plans without them needs no numpy.
    from skillc_runtime.world.space.bounding_boxes import TOUCH_M
    from skillc_runtime.world.space.neighbours import find_near_pairs

    facts = {}
    for relation, within_m in ((RESTS_ON, TOUCH_M), (BLOCKS, HAND_M)):
        pairs = PairIndexBuilder(PairIndex.empty())
        for one, other in find_near_pairs(state, OBJECT, within_m):
            if state.holds(one, relation, other):
                pairs.add(one, other)
        facts[relation] = pairs.build()
    return stated.apply(state, facts)
