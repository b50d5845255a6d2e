"""Reads from the facts which parts of a surface are to be worked on, along which axis and with which force."""

from __future__ import annotations

from math import atan2

from skillc_runtime.motion.arrays import np
from skillc_runtime.motion.lanes import Direction
from skillc_runtime.motion.layout import Hole, Layout, Patch
from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.world.space.frames import relative_pose, size
from skillc_runtime.world.state.data_sheet import SheetError, number_of
from skillc_runtime.world.state.terms import (
    ALONG_AXIS,
    DIRT_FRICTION,
    HAS_HOLE,
    HAS_PATCH,
    LEAST_CONTACT,
    LEAST_FORCE,
    MARGIN,
    SIZE,
)
from skillc_runtime.world.state.world_state import WorldState

MARGIN_M = 0.02
"""The margin around holes that do not state one."""

LEAST_FORCE_N, LEAST_SHARE = 1.0, 0.75
"""The values for surfaces that do not state them."""


def surface_layout(state: WorldState, surface: str) -> Layout:
    """Return size, patches and holes of a surface in its frame; FrameError or SheetError when a fact is missing."""
    patches, holes = (sorted(state.objects(surface, relation)) for relation in (HAS_PATCH, HAS_HOLE))
    return Layout(
        size(state, surface)[:2],
        tuple(_patch(state, surface, patch) for patch in patches),
        tuple(_hole(state, surface, hole) for hole in holes),
    )


def lane_direction(state: WorldState, surface: str) -> Direction:
    """Return the axis of a surface along which lanes run; SheetError for an unknown axis."""
    match state.value(surface, ALONG_AXIS):
        case None:
            return "longer"
        case "x":
            return "x"
        case "y":
            return "y"
        case other:
            short = state.vocabulary.short
            raise SheetError(f"{short(surface)} has the {short(ALONG_AXIS)} {other!r}; there are x and y")


def least_force_n(state: WorldState, surface: str) -> float:
    """Return the force in N below which a tool has no effect on a surface."""
    return number_of(state, surface, LEAST_FORCE, default=LEAST_FORCE_N)


def dirt_friction(state: WorldState, surface: str) -> float:
    """Return the friction of dirt as a share of that of the clean surface: 1 if nothing is known of it.

    The vocabulary of an old recording does not have the property.
    """
    if DIRT_FRICTION not in state.vocabulary.properties:
        return 1.0
    return number_of(state, surface, DIRT_FRICTION, default=1.0)


def least_contact_share(state: WorldState, surface: str) -> float:
    """Return the share of the time along a path, from 0 to 1, in which a tool must press on a surface."""
    return number_of(state, surface, LEAST_CONTACT, default=LEAST_SHARE)


def _patch(state: WorldState, surface: str, patch: str) -> Patch:
    return Patch(_in_plane(relative_pose(state, surface, patch)), _extent(state, patch))


def _hole(state: WorldState, surface: str, hole: str) -> Hole:
    """Return the smallest rectangle along the surface's axes that contains the hole."""
    margin = number_of(state, hole, MARGIN, default=MARGIN_M)
    frame, height = _in_plane(relative_pose(state, surface, hole)), number_of(state, hole, SIZE[2], default=0.0)
    return Hole(np.zeros(2), _extent(state, hole), margin, height).in_frame(frame.inverse())


def _extent(state: WorldState, area: str) -> Array:
    return np.array([number_of(state, area, name) for name in SIZE[:2]])


def _in_plane(pose: Pose) -> Pose:
    """Return a pose in the surface frame projected onto the surface plane."""
    x = pose.rotation[:, 0]
    return Pose(np.append(pose.position[:2], 0.0), exp(np.array([0.0, 0.0, atan2(x[1], x[0])])))
