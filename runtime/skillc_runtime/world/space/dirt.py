"""What is known of where a surface is dirty: its map of cells, and the rectangles that are to be wiped."""

from __future__ import annotations

from msgspec.structs import replace

from skillc_runtime.motion.dirt_map import DirtMap, area, find_dirty_boxes, find_dirty_parts, parse_dirt_map
from skillc_runtime.motion.layout import Layout
from skillc_runtime.world.space.surfaces import surface_layout
from skillc_runtime.world.state.data_sheet import SheetError, number_of
from skillc_runtime.world.state.terms import DIRT_MAP, SIZE
from skillc_runtime.world.state.world_state import WorldState


def read_dirt_map(state: WorldState, surface: str) -> DirtMap | None:
    """Return the map of a surface, None if there is none; SheetError if it cannot be read."""
    text = state.value(surface, DIRT_MAP)
    try:
        return parse_dirt_map(text) if isinstance(text, str) else None
    except ValueError as error:
        short = state.vocabulary.short
        raise SheetError(f"the {short(DIRT_MAP)} of {short(surface)} cannot be read: {error}") from error


def dirty_share(state: WorldState, surface: str) -> float | None:
    """Return the share of a surface that was seen to be dirty, from 0 to 1; None if no map of it is known."""
    dirt = read_dirt_map(state, surface)
    return None if dirt is None else dirt.dirty_share


def patch_share(state: WorldState, surface: str) -> float | None:
    """Return the share of a surface, from 0 to 1, that the rectangles with its dirty cells have.

    None if nothing is known to be dirty: no map of it is known, or nothing on it is dirty.
    """
    dirt = read_dirt_map(state, surface)
    if dirt is None:
        return None
    x, y = (number_of(state, surface, each) for each in SIZE[:2])
    boxes = find_dirty_boxes(dirt, (x, y))
    return min(1.0, sum(map(area, boxes)) / (x * y)) if boxes else None


def work_layout(state: WorldState, surface: str) -> Layout:
    """Return what is to be worked on: the stated patches, else the rectangles with dirty cells, else all.

    FrameError or SheetError if a fact is missing.
    """
    layout = surface_layout(state, surface)
    dirt = None if layout.patches else read_dirt_map(state, surface)
    if dirt is None:
        return layout
    x, y = map(float, layout.size)
    return replace(layout, patches=find_dirty_parts(dirt, (x, y)))
