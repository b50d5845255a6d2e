"""Checks that no thing lies inside another."""

from __future__ import annotations

from collections.abc import Iterator

from skillc.services.cell_checks.facts import ROUNDED_M, placing_fact, severity_of
from skillc_runtime.collision.solid_geoms import overlap_depths
from skillc_runtime.scene.violation import SceneViolation
from skillc_runtime.world.space.occupants import Occupant, near_pairs
from skillc_runtime.world.state.terms import CONTAIN, HAS_A, MOBILE_ROBOT, ON
from skillc_runtime.world.state.world_state import WorldState

MOUNTED = (HAS_A, CONTAIN, ON)
"""What puts one thing into or onto another."""


def check_overlaps(state: WorldState, occupants: tuple[Occupant, ...]) -> Iterator[SceneViolation]:
    """Yield each pair of things that overlap.

    Of two that are fixed only if neither is stated to be a part of the other, in it or on it: what is mounted may reach
    into what carries it.
    """
    pairs = [
        pair for pair in near_pairs(occupants) if any(_moves(state, each) for each in pair) or _apart(state, *pair)
    ]
    depths = overlap_depths([(one.solids, other.solids) for one, other in pairs])
    for (one, other), depth_m in zip(pairs, depths, strict=True):
        if depth_m > ROUNDED_M:
            yield _overlap(state, _ordered(state, one, other), depth_m)


def _moves(state: WorldState, one: Occupant) -> bool:
    return one.movable or state.is_a(one.individual, MOBILE_ROBOT)


def _apart(state: WorldState, one: Occupant, other: Occupant) -> bool:
    """Whether nothing is stated that puts one of two things into or onto the other."""
    a, b = one.individual, other.individual
    return not any(state.holds(a, each, b) or state.holds(b, each, a) for each in MOUNTED)


def _ordered(state: WorldState, one: Occupant, other: Occupant) -> tuple[Occupant, Occupant]:
    """Return two things, the one first that moves, and of two that move the one that comes first by IRI."""
    first, second = sorted((one, other), key=lambda each: (not _moves(state, each), each.individual))
    return first, second


def _overlap(state: WorldState, pair: tuple[Occupant, Occupant], depth_m: float) -> SceneViolation:
    short, (thing, other) = state.vocabulary.short, (each.individual for each in pair)
    message = f"{short(thing)} is {1e3 * depth_m:.0f} mm inside {short(other)}"
    cure = f"move one of them by {1e3 * depth_m:.0f} mm, or write their true sizes"
    place = placing_fact(state, thing)
    moves = any(_moves(state, each) for each in pair)
    severity = severity_of(depth_m) if moves else "warning"
    return SceneViolation(thing, place, "inside-another", message, cure, severity, (other,))
