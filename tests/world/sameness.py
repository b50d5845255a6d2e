"""Whether two versions of a world answer everything alike."""

from __future__ import annotations

from typing import Any

from skillc_runtime.world.state.values import Value
from skillc_runtime.world.state.world_state import WorldState


def everything(state: WorldState) -> dict[str, Any]:
    """Return all that a version says and indexes, such that equal ones are equal."""
    relations = state.vocabulary.relations
    return {
        "direct": dict(state.direct.items()),
        "classes": dict(state.classes.items()),
        "members": {cls: members.members() for cls, members in state.members.items() if members.members()},
        "asserted": {iri: _both_ways(state, state.asserted, iri) for iri in relations},
        "facts": {iri: _both_ways(state, state.facts, iri) for iri in relations},
        "stored": {iri: _values(table.items()) for iri, table in state.stored.items()},
        "vocabulary": (state.vocabulary.classes, state.vocabulary.prefixes),
    }


def _both_ways(_state: WorldState, links: Any, iri: str) -> tuple[dict[str, Any], dict[str, Any]]:
    forward, backward = links[iri].forward, links[iri].backward
    return {a: b for a, b in forward.items() if b}, {a: b for a, b in backward.items() if b}


def _values(found: Any) -> dict[str, tuple[type, Value]]:
    """Values with their types: 1, 1.0 and true are not the same."""
    return {individual: (type(value), value) for individual, value in found if value is not None}
