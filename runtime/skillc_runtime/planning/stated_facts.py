"""Versions of the world for planners, in which relations are stated that the world itself does not state."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import msgspec

from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.world.state.axioms import WorldAxioms
from skillc_runtime.world.state.versioned import PairIndex
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, eq=False, slots=True)
class LibraryKey:
    """A library as a cache key: the same if its skills are the same objects."""

    library: SkillLibrary

    def __eq__(self, other: object) -> bool:
        return isinstance(other, LibraryKey) and self.library.skills is other.library.skills

    def __hash__(self) -> int:
        return id(self.library.skills)


@dataclass(frozen=True, eq=False, slots=True)
class VocabularyKey:
    """A vocabulary as a cache key: the same if it is equal, as those of several scenes of one library often are."""

    vocabulary: Vocabulary

    def __eq__(self, other: object) -> bool:
        return isinstance(other, VocabularyKey) and self.vocabulary == other.vocabulary

    def __hash__(self) -> int:
        return hash((len(self.vocabulary.classes), len(self.vocabulary.relations), len(self.vocabulary.properties)))


class StatedTerms(msgspec.Struct, frozen=True, eq=False):
    """A vocabulary in which relations are stated that the world has not or computes, and its axioms."""

    vocabulary: Vocabulary
    axioms: WorldAxioms

    @staticmethod
    def of(vocabulary: Vocabulary) -> StatedTerms:
        """Return a vocabulary with its axioms."""
        return StatedTerms(vocabulary, WorldAxioms(vocabulary))

    def apply(self, state: WorldState, facts: Mapping[str, PairIndex]) -> WorldState:
        """Return a version of the world with the facts of these relations, by IRI."""
        return replace(
            state,
            vocabulary=self.vocabulary,
            axioms=self.axioms,
            asserted={**state.asserted, **facts},
            facts={**state.facts, **facts},
        )
