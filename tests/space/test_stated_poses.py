"""Poses stated by angles, or by the face of a thing that another one is on."""

from __future__ import annotations

from math import degrees
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from skillc.services.library import libraries
from skillc_runtime.motion.pose import angles_from_rotation, exp, rotation_from_angles
from skillc_runtime.scene.load import load_scene, load_sheets
from skillc_runtime.scene.saving import save_scene
from skillc_runtime.world.space.bounding_boxes import bounding_box
from skillc_runtime.world.space.frame_tree import MissingFact
from skillc_runtime.world.space.frames import attachment_changes, pose, relocation_changes, states_own_pose
from skillc_runtime.world.space.shape.extents import FACES
from skillc_runtime.world.state.changes import Change, ClearProperty, SetProperty
from skillc_runtime.world.state.terms import (
    ANCHOR,
    ANGLES,
    FACE,
    FURNITURE,
    MOBILE_ROBOT,
    OFFSET,
    ON,
    SCENE,
    SIZE,
    WORKSTATION,
)
from skillc_runtime.world.state.world_state import WorldState
from space.rooms import PART, at, lab, linked, poses, same, skillc, thing, world

TABLE = thing("Table", at(0, 0, 0.7), size=(1.0, 0.6, 0.7), cls=FURNITURE)
degrees_of = st.tuples(*[st.floats(-180, 180)] * 3)


def on(
    name: str, support: str, *, size: tuple[float, ...] = (), cls: str = PART, **stated: float | str
) -> list[Change]:
    """Return what says that there is a thing on another; `stated` are its offsets, angles, face and anchor."""
    values = [SetProperty(lab(name), skillc(each), value) for each, value in stated.items()]
    return [*thing(name, size=size, cls=cls), linked(name, ON, support), *values]


def placed(*changes: list[Change]) -> list[float]:
    """Return the position of the part in a world with a table."""
    found: list[float] = pose(world(TABLE, *changes), lab("Part")).position.round(9).tolist()
    return found


@given(degrees_of)
def test_roll_is_first_then_pitch_then_yaw_about_the_axes_of_the_frame(angles: tuple[float, float, float]) -> None:
    roll, pitch, yaw = np.radians(angles)
    x, y, z = np.eye(3)
    rotation = rotation_from_angles(roll, pitch, yaw)
    assert np.allclose(rotation, exp(z * yaw) @ exp(y * pitch) @ exp(x * roll))
    assert np.allclose(rotation_from_angles(*angles_from_rotation(rotation)), rotation, atol=1e-7)


@pytest.mark.parametrize("pitch", [90.0, -90.0])
def test_angles_of_a_rotation_are_found_where_roll_and_yaw_are_one(pitch: float) -> None:
    rotation = rotation_from_angles(*np.radians((20.0, pitch, 50.0)))
    roll, found, yaw = angles_from_rotation(rotation)
    assert (roll, round(degrees(found), 6)) == (0.0, pitch)
    assert np.allclose(rotation_from_angles(roll, found, yaw), rotation)


def test_a_part_stands_on_the_top_at_an_offset_from_the_middle_or_the_corner() -> None:
    size = (0.1, 0.1, 0.04)
    assert placed(on("Part", "Table", size=size)) == [0, 0, 0.72]
    assert placed(on("Part", "Table", size=size, atX=0.2, atY=-0.1, atZ=0.01)) == [0.2, -0.1, 0.73]
    assert placed(on("Part", "Table", size=size, atX=0.2, atY=0.1, anchor="corner")) == [-0.3, -0.2, 0.72]
    assert placed(on("Part", "Table", atX=0.2)) == [0.2, 0, 0.7], "without a size it is a point"
    assert placed(on("Part", "Table", size=(0.1, 0.1, 0.4), pitch=90.0)) == [0, 0, 0.75], "it lies on its side"


def test_the_offset_is_along_the_axes_of_what_it_is_on() -> None:
    turned = [*thing("Table", size=(1.0, 0.6, 0.7), cls=FURNITURE), *on("Table", "Cell", yaw=90.0, atX=2.0)]
    state = world(thing("Cell", cls=SCENE), turned, on("Part", "Table", atX=0.2))
    assert np.allclose(pose(state, lab("Part")).position, (2.0, 0.2, 0.7))
    assert np.allclose(pose(state, lab("Part")).rotation[:, 0], (0, 1, 0)), "it is turned with what it is on"


def test_things_stand_on_the_floor_of_the_scene_and_of_a_place_without_a_size() -> None:
    cell = thing("Cell", cls=SCENE)
    station = thing("Station", at(5, 0, 0), cls=WORKSTATION)
    robot = on("Robot", "Cell", size=(0.7, 0.5, 0.6), cls=MOBILE_ROBOT)
    table = on("Shelf", "Station", size=(1.0, 1.0, 2.0), cls=FURNITURE)
    state = world(cell, station, robot, table)
    assert np.allclose(pose(state, lab("Robot")).position, (0, 0, 0)), "the frame of a mobile robot is on the floor"
    assert np.allclose(pose(state, lab("Shelf")).position, (5, 0, 2.0)), "the frame of furniture is its top"
    assert all(abs(bounding_box(state, lab(each)).lowest) < 1e-12 for each in ("Robot", "Shelf"))


@given(
    st.sampled_from(sorted(FACES)),
    poses,
    degrees_of,
    st.sampled_from((PART, FURNITURE, MOBILE_ROBOT)),
    st.sampled_from(("centre", "corner")),
)
def test_the_boxes_touch_at_the_face_however_they_are_turned(
    face: str, carrier: object, angles: tuple[float, float, float], cls: str, anchor: str
) -> None:
    stated = dict(zip(("roll", "pitch", "yaw"), angles, strict=True))
    part = on("Part", "Table", size=(0.1, 0.2, 0.3), cls=cls, face=face, anchor=anchor, **stated)
    state = world(thing("Table", carrier, size=(1.0, 0.6, 0.7), cls=FURNITURE), part)  # type: ignore[arg-type]
    table, box = (bounding_box(state, lab(each)) for each in ("Table", "Part"))
    axis, direction = FACES[face]
    outward = (box.corners - table.middle.position) @ table.middle.rotation[:, axis] * direction
    assert np.isclose(outward.min(), table.half[axis], atol=1e-9)


def test_a_thing_without_a_size_carries_nothing() -> None:
    with pytest.raises(MissingFact, match=r"Table.* has no .*SizeZ"):
        pose(world(TABLE, [ClearProperty(lab("Table"), SIZE[2])], on("Part", "Table")), lab("Part"))
    state = world(thing("Station", at(0, 0, 0), cls=WORKSTATION), on("Part", "Station", face="front"))
    with pytest.raises(MissingFact, match="Station"):
        pose(state, lab("Part"))


def test_what_is_moved_elsewhere_is_on_nothing_any_more() -> None:
    part = on("Part", "Table", size=(0.1, 0.1, 0.1), atX=0.2, yaw=30.0, anchor="corner", face="top")
    state = world(TABLE, thing("Hand", at(3, 0, 0)), part)
    moved = state.with_changes(relocation_changes(state, lab("Part"), at(1, 2, 3)))
    carried = state.with_changes(attachment_changes(state, lab("Part"), lab("Hand")))
    assert same(pose(moved, lab("Part")), at(1, 2, 3))
    assert same(pose(carried, lab("Part")), pose(state, lab("Part")))
    for after in (moved, carried):
        assert not after.objects(lab("Part"), ON)
        assert states_own_pose(after, lab("Part"))
        assert all(after.value(lab("Part"), name) is None for name in (*ANGLES, *OFFSET, ANCHOR, FACE))


def test_a_thing_goes_with_what_it_is_on() -> None:
    state = world(TABLE, on("Part", "Table", atX=0.2), on("Screw", "Part"))
    assert states_own_pose(state, lab("Part"))
    sized = state.with_changes([SetProperty(lab("Part"), name, 0.1) for name in SIZE])
    driven = sized.with_changes(relocation_changes(sized, lab("Table"), at(4, 0, 1.0)))
    assert np.allclose(pose(sized, lab("Screw")).position, (0.2, 0, 0.8))
    assert np.allclose(pose(driven, lab("Screw")).position, (4.2, 0, 1.1))


SCENE_TEXT = """
@prefix lab: <http://example.org/lab#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

lab:Cell a skiros:Scene ; skiros:contain lab:Part .
lab:Table a skillc:Furniture ; skiros:SizeX 1.0 ; skiros:SizeY 0.6 ; skiros:SizeZ 0.7 ; skillc:on lab:Cell .
lab:Part a skiros:Product ; skiros:SizeX 0.1 ; skiros:SizeY 0.1 ; skiros:SizeZ 0.1 ;
    skillc:on lab:Table ; skillc:atX 0.2 ; skillc:yaw 30 .
"""


def test_a_scene_is_saved_as_it_was_stated_and_moved_things_can_be_saved(tmp_path: Path) -> None:
    vocabulary = libraries.load_vocabulary()
    (tmp_path / "cell.ttl").write_text(SCENE_TEXT, "utf-8")
    state = load_scene(tmp_path / "cell.ttl", vocabulary)
    for each in (state, state.with_changes(relocation_changes(state, lab("Part"), at(1, 2, 3)))):
        again = saved(each, tmp_path / "again.ttl")
        assert same(pose(again, lab("Part")), pose(each, lab("Part")))
        assert again.objects(lab("Part"), ON) == each.objects(lab("Part"), ON)
    assert "skillc:yaw" not in (tmp_path / "again.ttl").read_text("utf-8")


def saved(state: WorldState, path: Path) -> WorldState:
    """Return the world that is loaded from the saved one."""
    vocabulary = libraries.load_vocabulary()
    save_scene(state, path, load_sheets(vocabulary))
    return load_scene(path, vocabulary)
