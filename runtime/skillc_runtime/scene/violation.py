"""Violations of scene checks, and a helper to read stored values."""

from __future__ import annotations

import msgspec

from skillc_dsl.diagnostics import Severity
from skillc_runtime.world.state.world_state import WorldState


class SceneViolation(msgspec.Struct, frozen=True):
    """A violation of an individual, by name; `predicate` is that of the wrong statement, None if one is missing.

    `others` are further individuals that take part in it. `prevents` is the computed relation to the individual that
    does not hold because of it.
    """

    individual: str
    predicate: str | None
    name: str
    message: str
    help: str = ""
    severity: Severity = "error"
    others: tuple[str, ...] = ()
    prevents: str | None = None


def stored_values(state: WorldState, property_: str) -> list[tuple[str, object]]:
    """Return the individuals with a property and their values, sorted by IRI."""
    table = state.stored.get(property_)
    found = [(individual, value) for individual, value in table.items() if value is not None] if table else []
    return sorted(found, key=lambda pair: pair[0])
