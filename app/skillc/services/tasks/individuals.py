"""The individuals of a world as texts name them: with the classes that a library knows."""

from __future__ import annotations

from typing import TypeAlias

from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.world.state.world_state import WorldState

Individuals: TypeAlias = dict[str, list[str]]
"""The IRIs of a scene with their classes."""


def classes_by_individual(state: WorldState, vocabulary: Vocabulary) -> Individuals:
    """Return the individuals of a world with their classes that the library's vocabulary has, or the nearest above."""
    known = vocabulary.classes.keys()
    above = state.vocabulary.ancestors
    return {
        iri: sorted({each for cls in state.types(iri) for each in ({cls} if cls in known else above[cls] & known)})
        for iri in state.individuals
    }
