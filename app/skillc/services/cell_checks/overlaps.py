"""Checks that no thing that is moved lies inside another."""

from __future__ import annotations

from collections.abc import Iterator

from skillc.services.cell_checks.facts import ROUNDED_M, placing_fact, severity_of
from skillc_runtime.collision.solid_geoms import overlap_depths
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.occupants import Occupant, near_pairs
from skillc_runtime.world.state.terms import MOBILE_ROBOT
from skillc_runtime.world.state.world_state import WorldState


def check_overlaps(state: WorldState, occupants: tuple[Occupant, ...]) -> Iterator[SceneViolation]:
    """Yield each pair of things that overlap, one of which lies free or drives; what is fixed may overlap."""
    pairs = [(one, other) for one, other in near_pairs(occupants) if _moves(state, one) or _moves(state, other)]
    depths = overlap_depths([(one.solids, other.solids) for one, other in pairs])
    for (one, other), depth_m in zip(pairs, depths, strict=True):
        if depth_m > ROUNDED_M:
            yield _overlap(state, *_ordered(state, one, other), depth_m)


def _moves(state: WorldState, one: Occupant) -> bool:
    return one.movable or state.is_a(one.individual, MOBILE_ROBOT)


def _ordered(state: WorldState, one: Occupant, other: Occupant) -> tuple[str, str]:
    """Return two things, the one first that moves, and of two that move the one that comes first by IRI."""
    first, second = sorted((one, other), key=lambda each: (not _moves(state, each), each.individual))
    return first.individual, second.individual


def _overlap(state: WorldState, thing: str, other: str, depth_m: float) -> SceneViolation:
    short = state.vocabulary.short
    message = f"{short(thing)} is {1e3 * depth_m:.0f} mm inside {short(other)}"
    cure = f"move one of them by {1e3 * depth_m:.0f} mm, or write their true sizes"
    place = placing_fact(state, thing)
    return SceneViolation(thing, place, "inside-another", message, cure, severity_of(depth_m), (other,))
