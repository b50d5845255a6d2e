"""Checks that the maps of where surfaces are dirty can be read."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_runtime.motion.dirt_map import parse_dirt_map
from skillc_runtime.scene.violation import SceneViolation, stored_values
from skillc_runtime.world.state.terms import DIRT_MAP
from skillc_runtime.world.state.world_state import WorldState

HELP = "write columns x rows, then how many cells are clean (c), dirty (d), not seen (u) or spared (s): `2x3 5c 1d`"


def check_dirt_maps(state: WorldState) -> Iterator[SceneViolation]:
    """Yield the maps that cannot be read, with the reason."""
    short = state.vocabulary.short
    for surface, text in stored_values(state, DIRT_MAP):
        try:
            parse_dirt_map(str(text))
        except ValueError as error:
            message = f"the {short(DIRT_MAP)} of {short(surface)} cannot be read: {error}"
            yield SceneViolation(surface, DIRT_MAP, "unreadable-map", message, HELP)
