"""Adds, moves and removes things in a scene file, written as a person would write them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeAlias

import pyoxigraph as ox

from skillc.errors import RequestError, ServiceError
from skillc.services.scene.scene_file import SceneFile
from skillc.services.scene.sheets import find_sheet
from skillc.services.scene.slots import frame_of, make_slots
from skillc_rdf.turtle.editing import StatementNotFound
from skillc_rdf.turtle.statements import Node
from skillc_rdf.turtle.terms import RDF_TYPE, XSD
from skillc_runtime.world.state.terms import (
    ANCHOR,
    ANGLES,
    BASE_FRAME_ID,
    BOARD,
    CONTAIN,
    CONTAINER,
    FACE,
    FIXTURE,
    FRAME_ID,
    FURNITURE,
    HAS_A,
    HAS_SHEET,
    LOCATION,
    MANIPULATABLE,
    OFFSET,
    ON,
    ORIENTATION,
    POSITION,
    SHAPE,
    SIZE,
    WEIGHT,
    WORKSTATION,
)
from skillc_runtime.world.state.world_state import WorldState

LABEL = "http://www.w3.org/2000/01/rdf-schema#label"
CONTAINED = (MANIPULATABLE, CONTAINER, FURNITURE, FIXTURE, LOCATION)
"""Classes of what skills find by the place that contains it."""

Number: TypeAlias = str
"""A number as it was typed, so that 0.20 is written as 0.20."""

Pairs: TypeAlias = list[tuple[str, Node]]
_ON = (ON, *OFFSET, ANCHOR, FACE, BOARD)
_IN_FRAME = (BASE_FRAME_ID, *POSITION)
_POSE = (*_ON, *_IN_FRAME, *ORIENTATION, *ANGLES)
_NUMBER = re.compile(r"[+-]?(?:\d+|\d*\.\d+)")


@dataclass(frozen=True, slots=True)
class PoseRequest:
    """Where a thing shall be: on another at offsets in m, or at a position in m in a frame; angles in degrees.

    None and empty tuples are not stated. `at` has two or three numbers.
    """

    on: str | None = None
    at: tuple[Number, ...] = ()
    anchor: str | None = None
    face: str | None = None
    position: tuple[Number, ...] = ()
    frame: str | None = None
    angles: tuple[Number | None, Number | None, Number | None] = (None, None, None)
    board: Number | None = None

    @property
    def is_stated(self) -> bool:
        """Whether anything is stated."""
        return self != PoseRequest()


@dataclass(frozen=True, slots=True)
class ThingRequest:
    """A new thing: its name and class, its label, its size in m, its mass in kg, its shape, and what contains it.

    slots: how many slots for parts it has along x and y, none if empty. sheet: its data sheet, by default the
    shipped one for its class, if it needs one.
    """

    name: str
    cls: str
    label: str | None = None
    size: tuple[Number, ...] = ()
    weight: Number | None = None
    shape: str | None = None
    inside: str | None = None
    slots: tuple[int, ...] = ()
    sheet: str | None = None


def add_thing(scene: Path, state: WorldState, thing: ThingRequest, pose: PoseRequest) -> str:
    """Add a thing to a scene file and return what was added. ServiceError, and the file unchanged, if it has errors.

    A thing with a size of which nothing says where it is stands on the floor of the only workstation. The place that
    contains what it stands on contains it, unless another is named.
    """
    file = SceneFile(scene, state)
    if (thing.size or pose.at) and not (thing.inside or pose.on or pose.position):
        pose = replace(pose, on=_find_floor(state))
    iri = file.name_new_thing(thing.name)
    cls = file.find_class(thing.cls)
    kind: Pairs = [(RDF_TYPE, ox.NamedNode(cls))]
    if thing.label is not None:
        kind.append((LABEL, ox.Literal(thing.label)))
    sheet = find_sheet(cls, thing.sheet, state)
    if sheet is not None:
        kind.append((HAS_SHEET, ox.NamedNode(sheet)))
    body: Pairs = [(name, _number(each)) for name, each in zip(SIZE, thing.size, strict=False)]
    if thing.weight is not None:
        body.append((WEIGHT, _number(thing.weight)))
    if thing.shape is not None:
        body.append((SHAPE, ox.Literal(thing.shape)))
    place = file.find_thing(thing.inside) if thing.inside else _find_place(file, state, cls, pose.on)
    if place is not None:
        file.editor.add(place, CONTAIN, ox.NamedNode(iri))
    slots = make_slots(iri, cls, thing.size, thing.slots, state) if thing.slots else ()
    rack: Pairs = [(FRAME_ID, ox.Literal(frame_of(iri))), *((HAS_A, ox.NamedNode(each.iri)) for each in slots)]
    placed = [*_place(file, pose), *_turn(pose, in_frame=bool(pose.position))]
    file.append(iri, (kind, body, placed, rack if slots else ()))
    for each in slots:
        file.append(each.iri, each.rows)
    file.write()
    short = state.vocabulary.short
    if place is not None:
        return f"{short(iri)} added, in {short(place)}"
    lost = any(state.vocabulary.is_a(cls, each) for each in CONTAINED)
    return f"{short(iri)} added" + ("; no place contains it, so no skill finds it: say --in PLACE" if lost else "")


def _find_place(file: SceneFile, state: WorldState, cls: str, on: str | None) -> str | None:
    """Return the place in which a thing of a class is that stands on another; None if there is none."""
    if on is None or not any(state.vocabulary.is_a(cls, each) for each in CONTAINED):
        return None
    carrier = file.find_thing(on)
    return carrier if state.is_a(carrier, WORKSTATION) else min(state.subjects(CONTAIN, carrier), default=None)


def _find_floor(state: WorldState) -> str:
    floors = sorted(state.instances(WORKSTATION))
    if len(floors) != 1:
        raise RequestError("say where it is: --on THING with --at X Y, --in PLACE, or --position X Y Z")
    return state.vocabulary.short(floors[0])


def move_thing(scene: Path, state: WorldState, name: str, pose: PoseRequest) -> str:
    """Move a thing of a scene file and return its short name; what is not stated stays as it is written.

    Where it is on one thing says nothing of where it is on another.

    ServiceError, and the file unchanged, if the scene would have errors.
    """
    if not pose.is_stated:
        raise RequestError("say where to: --on THING, --at X Y, --position X Y Z or an angle such as --yaw 90")
    file = SceneFile(scene, state)
    thing = file.find_thing(name)
    short, pairs = state.vocabulary.short(thing), dict(_place(file, pose))
    if pairs and not pose.on and not pose.position and not state.objects(thing, ON):
        raise ServiceError(f"{short} is on nothing; write --on THING with --at, or --position X Y Z in its frame")
    stays = pose.on is not None and file.find_thing(pose.on) in state.objects(thing, ON)
    replaced = [*_ON, *_IN_FRAME] if pose.position or (pose.on and not stays) else []
    if pose.position and pose.frame is None and (frame := state.value(thing, BASE_FRAME_ID)) is not None:
        pairs[BASE_FRAME_ID] = ox.Literal(str(frame))
    turned = any(state.value(thing, each) is not None for each in (*ORIENTATION, *ANGLES))
    turn = dict(_turn(pose, in_frame=bool(pose.position) and not turned))
    file.declare([*pairs, *turn])
    file.editor.replace(thing, [*replaced, *(ORIENTATION if turn else ())], pairs | turn, _POSE)
    file.write()
    return short


def remove_things(scene: Path, state: WorldState, names: Sequence[str]) -> list[str]:
    """Remove things and all statements about them, and return their short names.

    ServiceError, and the file unchanged, if other statements need them.
    """
    file = SceneFile(scene, state)
    things = list(dict.fromkeys(map(file.find_thing, names)))
    short = state.vocabulary.short
    for each in things:
        left = sorted(state.subjects(ON, each) - set(things))
        if left:
            raise ServiceError(f"{short(left[0])} is on {short(each)}: move it or remove it, too")
        try:
            file.editor.forget(each)
        except StatementNotFound:
            raise ServiceError(f"{scene} says nothing about {short(each)}") from None
    file.write()
    return list(map(short, things))


def _place(file: SceneFile, pose: PoseRequest) -> Pairs:
    """Return the facts of a place: what it is on with offsets, or a position in a frame."""
    offset: Pairs = [(name, _number(each)) for name, each in zip(OFFSET, pose.at, strict=False)]
    if pose.position or pose.frame is not None:
        if pose.on or offset or pose.anchor or pose.face or pose.board:
            raise RequestError("a place is --on THING with --at, or --position in a --frame, not both")
        if not pose.position:
            raise RequestError("--frame needs --position X Y Z")
        frame = ox.Literal(pose.frame or "map")
        return [(BASE_FRAME_ID, frame), *zip(POSITION, map(_number, pose.position), strict=True)]
    on: Pairs = [(ON, ox.NamedNode(file.find_thing(pose.on)))] if pose.on else []
    face: Pairs = [(FACE, ox.Literal(pose.face))] if pose.face else []
    anchor: Pairs = [(ANCHOR, ox.Literal(pose.anchor))] if pose.anchor else []
    board: Pairs = [(BOARD, _number(pose.board))] if pose.board else []
    return [*on, *board, *face, *anchor, *offset]


def _turn(pose: PoseRequest, in_frame: bool) -> Pairs:
    """Return the angles; a pose in a frame needs at least one."""
    angles: Pairs = [(name, _number(each)) for name, each in zip(ANGLES, pose.angles, strict=True) if each is not None]
    return angles or ([(ANGLES[2], _number("0.0"))] if in_frame else [])


def _number(text: Number) -> ox.Literal:
    if not _NUMBER.fullmatch(text):
        text = repr(float(text))
    kind = "double" if "e" in text else "decimal" if "." in text else "integer"
    return ox.Literal(text, datatype=ox.NamedNode(XSD + kind))
