"""What follows from a relation by super-relations, inverses and symmetry."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from skillc_compiler.library.vocabulary import RelationTerm

Directed: TypeAlias = tuple[str, bool]
"""A relation, and whether it is read from object to subject."""


def implied(relations: Mapping[str, RelationTerm]) -> dict[str, tuple[Directed, ...]]:
    """Return for each relation all that it implies, itself too, sorted."""
    steps: dict[str, set[Directed]] = {iri: set() for iri in relations}
    for iri, term in relations.items():
        steps[iri].update((parent, False) for parent in term.parents if parent in relations)
        if term.inverse is not None and term.inverse in relations:
            steps[iri].add((term.inverse, True))
            steps[term.inverse].add((iri, True))
        if term.symmetric:
            steps[iri].add((iri, True))
    return {iri: _reached(iri, steps) for iri in relations}


def _reached(start: str, steps: Mapping[str, set[Directed]]) -> tuple[Directed, ...]:
    seen: set[Directed] = set()
    todo: list[Directed] = [(start, False)]
    while todo:
        relation, flipped = todo.pop()
        if (relation, flipped) not in seen:
            seen.add((relation, flipped))
            todo.extend((other, flipped != turn) for other, turn in steps[relation])
    return tuple(sorted(seen))
