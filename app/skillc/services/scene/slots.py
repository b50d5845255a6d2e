"""Slots of a rack as a grid: a placing pose for each, which `Place` fills in the order of their names."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import pyoxigraph as ox

from skillc.errors import RequestError
from skillc_rdf.turtle.statements import Node
from skillc_rdf.turtle.terms import RDF_TYPE, XSD
from skillc_rdf.vocabulary.types import local_name
from skillc_runtime.world.space.shape.shapes import BIN_WALL_M
from skillc_runtime.world.state.terms import ANGLES, BASE_FRAME_ID, CONTAINER, FRAME_ID, PLACING_POSE, POSITION
from skillc_runtime.world.state.world_state import WorldState

MOST_SLOTS = 200


class Slot(NamedTuple):
    """The IRI of a placing pose, and what is stated about it, in lines."""

    iri: str
    rows: tuple[tuple[tuple[str, Node], ...], ...]


def frame_of(iri: str) -> str:
    """Return the name of the frame of a new thing."""
    return local_name(iri).lower().replace("-", "_")


def make_slots(rack: str, cls: str, size: Sequence[str], counts: Sequence[int], state: WorldState) -> tuple[Slot, ...]:
    """Return slots on the floor of a rack of a size in m, in the middle of equal cells along x and y.

    RequestError if the rack is no container with a size, or there are too many slots.
    """
    if not state.vocabulary.is_a(cls, CONTAINER):
        raise RequestError(f"--slots: {state.vocabulary.short(cls)} is no skiros:Container, into which parts are put")
    if len(size) != 3:
        raise RequestError("--slots needs the size of the rack: --size X Y Z")
    if min(counts) < 1 or counts[0] * counts[1] > MOST_SLOTS:
        raise RequestError(f"--slots: write two whole numbers from 1 whose product is at most {MOST_SLOTS}")
    x, y, z = map(float, size)
    x, y = x - 2 * BIN_WALL_M, y - 2 * BIN_WALL_M
    columns, rows = counts
    width = len(str(max(counts)))
    found = []
    for column in range(columns):
        for row in range(rows):
            at = (((column + 0.5) / columns - 0.5) * x, ((row + 0.5) / rows - 0.5) * y, BIN_WALL_M - z / 2)
            iri = f"{rack}-slot-{column + 1:0{width}}-{row + 1:0{width}}"
            found.append(Slot(iri, _state(iri, frame_of(rack), at)))
    return tuple(found)


def _state(iri: str, frame: str, at: tuple[float, ...]) -> tuple[tuple[tuple[str, Node], ...], ...]:
    placed = tuple((name, _number(each)) for name, each in zip(POSITION, at, strict=True))
    return (
        ((RDF_TYPE, ox.NamedNode(PLACING_POSE)), (FRAME_ID, ox.Literal(frame_of(iri)))),
        ((BASE_FRAME_ID, ox.Literal(frame)), *placed, (ANGLES[0], _number(180))),
    )


def _number(value: float) -> ox.Literal:
    text = f"{round(value, 5) + 0.0:g}"
    return ox.Literal(text, datatype=ox.NamedNode(XSD + ("decimal" if "." in text else "integer")))
