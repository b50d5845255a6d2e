"""What is wrong with a world as a whole, and how rules about it read what the world says."""

from __future__ import annotations

from dataclasses import dataclass

from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class SceneViolation:
    """What is wrong with an individual: the predicate of the statement that shows it, None where one is missing."""

    individual: str
    predicate: str | None
    name: str
    message: str
    help: str = ""


def stored_values(state: WorldState, property_: str) -> list[tuple[str, object]]:
    """Return the individuals that have the property with their values, sorted by IRI."""
    table = state.stored.get(property_)
    found = [(individual, value) for individual, value in table.items() if value is not None] if table else []
    return sorted(found, key=lambda pair: pair[0])
