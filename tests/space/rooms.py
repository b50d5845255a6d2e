"""Worlds in which things have places and sizes, on the vocabularies that ship."""

from __future__ import annotations

import numpy as np
from hypothesis import strategies as st

from skillc.services.library import libraries
from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.terms import FRAME_ID, SIZE, SKILLC, SKIROS
from skillc_runtime.world.state.world_state import WorldState

LAB = "http://example.org/lab#"
PART = SKIROS + "Part"
EMPTY = WorldState.empty(libraries.load_vocabulary())


def lab(name: str) -> str:
    """Return the IRI of an individual."""
    return LAB + name


def skillc(name: str) -> str:
    """Return the IRI of a term."""
    return SKILLC + name


def thing(
    name: str, at: Pose | None = None, frame: str = "map", size: tuple[float, ...] = (), cls: str = PART
) -> list[Change]:
    """Return what says that there is a thing with a frame of its own name, and where and how large it is."""
    changes: list[Change] = [AddIndividual(lab(name), (cls,)), SetProperty(lab(name), FRAME_ID, name)]
    changes += placement_changes(lab(name), at, frame) if at is not None else []
    return changes + [SetProperty(lab(name), axis, float(value)) for axis, value in zip(SIZE, size, strict=False)]


def linked(subject: str, relation: str, object_: str) -> AddRelation:
    """Return what says that one thing has a relation, an IRI, to another."""
    return AddRelation(lab(subject), relation, lab(object_))


def world(*changes: list[Change]) -> WorldState:
    """Return the world with these changes."""
    return EMPTY.with_changes([change for each in changes for change in each])


def at(x: float, y: float, z: float) -> Pose:
    """Return a pose that is not turned."""
    return Pose.of((x, y, z))


def same(one: Pose, other: Pose) -> bool:
    """Whether two poses agree up to rounding."""
    return bool(
        np.allclose(one.position, other.position, atol=1e-9) and np.allclose(one.rotation, other.rotation, atol=1e-9)
    )


def vectors(most: float) -> st.SearchStrategy[Array]:
    """Return vectors (3,) whose parts are no greater than this."""
    parts = st.floats(-most, most).map(lambda number: round(number, 6))
    return st.tuples(parts, parts, parts).map(np.array)


poses = st.builds(lambda position, turn: Pose(position, exp(turn)), vectors(5.0), vectors(3.0))
