"""The individuals of a scene, with their classes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

from skillc_rdf.vocabulary.types import THING, Vocabulary

Individuals: TypeAlias = Mapping[str, Sequence[str]]
"""The IRIs of a scene's individuals, each with those of its classes."""


def most_specific_classes(vocabulary: Vocabulary, individuals: Individuals) -> dict[str, str | None]:
    """Return the most specific class of each individual, None if there are several."""
    return {iri: _most_specific(vocabulary, classes) for iri, classes in individuals.items()}


def _most_specific(vocabulary: Vocabulary, classes: Sequence[str]) -> str | None:
    others = {one: [other for other in classes if other != one] for one in classes}
    lowest = [one for one, rest in others.items() if not any(vocabulary.is_a(other, one) for other in rest)]
    return lowest[0] if len(lowest) == 1 else (None if classes else THING)
