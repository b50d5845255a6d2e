"""What has a size has a body: its solids, mass, centre and friction, and what is wrong with impossible ones."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from skillc.services.library import libraries
from skillc_ontology import catalogue
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.space.bodies import RigidBody, read_bodies, read_body
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.changes import Change, SetProperty
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.terms import (
    AREA,
    CONTAINER,
    FURNITURE,
    LOCATION,
    SIZE,
    WEIGHT,
    WORKSPACE,
    WORKSTATION,
)
from space.rooms import PART, at, lab, skillc, thing, world

CUBE = (0.1, 0.2, 0.3)


def fact(name: str, property_: str, value: str | float) -> list[Change]:
    return [SetProperty(lab(name), skillc(property_) if ":" not in property_ else property_, value)]


def body(size: tuple[float, ...], cls: str = PART, **facts: str | float) -> RigidBody:
    """Return the body of a thing at 1 m of height."""
    found = read_body(
        world(thing("A", at(0, 0, 1), size=size, cls=cls), *(fact("A", key, value) for key, value in facts.items())),
        lab("A"),
    )
    assert found is not None
    return found


@pytest.mark.parametrize(
    ("shape", "size", "volume"),
    [
        ("box", CUBE, 0.006),
        ("cylinder", (0.2, 0.2, 0.5), pi * 0.01 * 0.5),
        ("sphere", (0.2, 0.2, 0.2), 4 / 3 * pi * 0.001),
        ("capsule", (0.2, 0.2, 0.2), 4 / 3 * pi * 0.001),
        ("capsule", (0.2, 0.2, 0.5), 4 / 3 * pi * 0.001 + pi * 0.01 * 0.3),
    ],
)
def test_a_solid_of_water(shape: str, size: tuple[float, ...], volume: float) -> None:
    found = body(size, shape=shape)
    assert [each.kind for each in found.solids] == ["sphere" if len(set(size)) == 1 else shape]
    assert found.solids[0].half == pytest.approx(tuple(each / 2 for each in size))
    assert found.mass_kg == pytest.approx(1000 * volume)
    assert found.centre == pytest.approx([0, 0, 0])
    assert found.movable


def test_a_bin_is_hollow() -> None:
    found = body((0.3, 0.2, 0.1), cls=CONTAINER, wallThickness=0.01, density=100.0)
    outer, inner = 0.3 * 0.2 * 0.1, 0.28 * 0.18 * 0.09
    assert not found.movable
    assert found.mass_kg == pytest.approx(100 * (outer - inner))
    assert found.centre[2] < -0.01
    for point in np.random.default_rng(0).uniform(-0.5, 0.5, (500, 3)) * (0.3, 0.2, 0.1):
        room = abs(point[0]) < 0.14 and abs(point[1]) < 0.09 and point[2] > -0.04
        full = [(np.abs(point - each.place.position) < each.half).all() for each in found.solids]
        assert sum(full) == (0 if room else 1)


def test_the_frame_of_furniture_is_in_its_top() -> None:
    found = body((1.0, 0.5, 0.7), cls=FURNITURE)
    assert found.solids[0].place.position == pytest.approx([0, 0, -0.35])
    assert found.centre == pytest.approx([0, 0, -0.35])


def test_what_is_stated_counts() -> None:
    found = body(CUBE, centreOfMass="0 0 -0.1", friction=0.2, colour="1 0 0", density=500.0)
    assert (found.mass_kg, found.friction, found.colour) == (pytest.approx(3.0), 0.2, (1.0, 0.0, 0.0, 1.0))
    assert found.centre == pytest.approx([0, 0, -0.1])
    weighed = read_body(world(thing("A", at(0, 0, 1), size=CUBE), [SetProperty(lab("A"), WEIGHT, 0.4)]), lab("A"))
    assert weighed is not None
    assert weighed.mass_kg == 0.4


@pytest.mark.parametrize(("cls", "movable"), [(PART, True), (LOCATION, False), (CONTAINER, False), (FURNITURE, False)])
def test_only_things_to_handle_move(cls: str, movable: bool) -> None:
    assert body(CUBE, cls=cls).movable == movable


def test_regions_and_what_has_no_size_or_pose_are_no_bodies() -> None:
    state = world(
        thing("Area", at(0, 0, 1), size=CUBE, cls=AREA),
        thing("Workspace", at(0, 0, 1), size=CUBE, cls=WORKSPACE),
        thing("Station", at(0, 0, 1), size=CUBE, cls=WORKSTATION),
        thing("Place", at(0, 0, 1), cls=LOCATION),
        thing("Lost", size=CUBE),
        thing("Real", at(0, 0, 1), size=CUBE),
    )
    assert [each.individual for each in read_bodies(state)] == [lab("Real")]


def test_the_bodies_of_a_shipped_scene_are_its_furniture() -> None:
    state = load_scene(catalogue.scene_path("iiwa_table"), libraries.load_vocabulary())
    assert [state.vocabulary.short(each.individual) for each in read_bodies(state)] == ["lab:Pedestal", "lab:SideTable"]


@pytest.mark.parametrize(
    ("size", "facts", "message"),
    [
        ((0.1, 0.2, 0.3), {"shape": "cylinder"}, "http:.*A is 0.1 x 0.2 m, but SizeX and SizeY of a cylinder"),
        ((0.1, 0.1, 0.3), {"shape": "sphere"}, "http:.*A is 0.1 x 0.1 x 0.3 m, but SizeX, SizeY and SizeZ"),
        ((0.1, 0.1, 0.05), {"shape": "capsule"}, "http:.*A is 0.05 m long, but a capsule is at least as long"),
        ((0.1, 0.1, 0.1), {"shape": "bin", "wallThickness": 0.05}, "so there is no room inside"),
        ((0.1, 0.1, 0.1), {"colour": "red"}, "http:.*A has the skillc:colour 'red'; it is three numbers"),
        ((0.1, 0.1, 0.1), {"centreOfMass": "1 2"}, "http:.*A has the skillc:centreOfMass '1 2'; it is three numbers"),
    ],
)
def test_impossible_bodies_say_why(size: tuple[float, ...], facts: dict[str, str | float], message: str) -> None:
    with pytest.raises(SheetError, match=message.replace("(", r"\(")):
        body(size, **facts)


def test_a_body_without_all_of_its_size_says_so() -> None:
    state = world(thing("A", at(0, 0, 1)), [SetProperty(lab("A"), SIZE[0], 0.1)])
    with pytest.raises(FrameError, match=r"http:.*A has no skiros:SizeY"):
        read_body(state, lab("A"))
