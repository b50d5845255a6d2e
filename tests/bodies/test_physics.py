"""Bodies of all shapes rest, fall, slip, tip, stack and lie in each other, as their facts say."""

from __future__ import annotations

from math import radians
from pathlib import Path

import numpy as np
import pytest

from simulation.cells import world as scene
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.motion.pose import Array, Pose, exp
from skillc_runtime.world.state.changes import AddRelation, Change, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import AREA, CONTAINER, FURNITURE, HAS_OPENING, LOCATION
from space.rooms import PART, at, lab, skillc, thing
from space.test_meshes import u_shape, write_obj

ASIDE = 2.0
"""Where there is nothing but the floor: m along x."""


def body(name: str, place: Pose, size: tuple[float, ...], cls: str = PART, **facts: str | float | int) -> list[Change]:
    """Return what says that there is a body, `ASIDE` of what its place says."""
    aside = Pose(place.position + np.array([ASIDE, 0.0, 0.0]), place.rotation)
    stated = [SetProperty(lab(name), skillc(key), value) for key, value in facts.items()]
    return [*thing(name, aside, size=size, cls=cls), *stated]


def settled(*changes: list[Change], seconds: float = 1.0) -> SimulatedCell:
    """Return the cell with these bodies after some time."""
    state = scene("panda_desk").with_changes([change for each in changes for change in each])
    cell = SimulatedCell(WorldModel(state))
    cell.advance(seconds)
    return cell


def place(cell: SimulatedCell, name: str = "A") -> Array:
    """Return where a body really is, (3,) in m, from `ASIDE`."""
    return np.asarray(cell.ground_truth.body_pose(lab(name)).position - np.array([ASIDE, 0.0, 0.0]))


SHAPES = {
    "box": (0.04, 0.05, 0.06),
    "cylinder": (0.04, 0.04, 0.06),
    "bin": (0.1, 0.08, 0.06),
    "table": (0.2, 0.15, 0.06),
    "shelf": (0.1, 0.08, 0.1),
    "panel": (0.1, 0.08, 0.02),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_what_stands_rests_where_it_is(shape: str) -> None:
    x, y, z = SHAPES[shape]
    thin = {"wallThickness": 0.004} if shape in ("bin", "table", "shelf") else {}
    cell = settled(body("A", at(0, 0, z / 2), (x, y, z), shape=shape, **thin))
    assert place(cell) == pytest.approx([0, 0, z / 2], abs=0.001)


@pytest.mark.parametrize(("shape", "size"), [("box", 0.05), ("sphere", 0.05), ("capsule", 0.05), ("cylinder", 0.05)])
def test_what_nothing_carries_falls(shape: str, size: float) -> None:
    cell = settled(body("A", at(0, 0, 0.3), (size, size, size), shape=shape))
    assert place(cell)[2] == pytest.approx(size / 2, abs=0.002)


@pytest.mark.parametrize(("friction", "stays"), [(0.4, False), (0.8, True)])
def test_what_is_slippery_slides_down_a_slope(friction: float, stays: bool) -> None:
    slope = Pose(np.array([0.0, 0.0, 0.5]), exp(np.array([0.0, radians(30), 0.0])))
    on_it = slope @ Pose.of((0.0, 0.0, 0.01))
    cell = settled(
        body("Slope", slope, (0.4, 0.4, 0.02), cls=FURNITURE, friction=0.0),
        body("A", on_it, (0.1, 0.1, 0.02), friction=friction),
    )
    assert (np.linalg.norm(place(cell) - on_it.position) < 0.003) == stays


@pytest.mark.parametrize(("centre", "stays"), [("0.01 0 0", True), ("0.03 0 0", False)])
def test_what_has_its_centre_of_mass_beyond_an_edge_tips_over(centre: str, stays: bool) -> None:
    cell = settled(
        body("Step", at(-0.3, 0, 0.2), (0.6, 0.2, 0.2), cls=FURNITURE),
        body("A", at(-0.02, 0, 0.21), (0.1, 0.05, 0.02), centreOfMass=centre),
    )
    assert (abs(place(cell)[2] - 0.21) < 0.002) == stays


def test_boxes_stack() -> None:
    tower = [body(name, at(0, 0, 0.02 + 0.04 * number), (0.04, 0.04, 0.04)) for number, name in enumerate("ABC")]
    cell = settled(*tower)
    for number, name in enumerate("ABC"):
        assert place(cell, name) == pytest.approx([0, 0, 0.02 + 0.04 * number], abs=0.002)


def test_a_bin_holds_what_falls_into_it_and_a_box_does_not() -> None:
    ball = body("A", at(0.03, 0.02, 0.2), (0.04, 0.04, 0.04), shape="sphere")
    size = (0.2, 0.2, 0.1)
    assert place(settled(ball, body("Bin", at(0, 0, 0.05), size, cls=CONTAINER)))[2] == pytest.approx(0.024, abs=0.002)
    assert place(settled(ball, body("Bin", at(0, 0, 0.05), size, cls=CONTAINER, shape="box")))[2] > 0.11


def test_a_part_lies_on_each_board_of_a_shelf() -> None:
    heights = [0.01 + 0.27 * number for number in range(4)]
    shelf = body("Shelf", at(0, 0, 0.415), (0.5, 0.3, 0.83), shape="shelf", cls=CONTAINER, boards=4, wallThickness=0.02)
    parts = [body(f"A{n}", at(0, 0, 0.01 + height + 0.02), (0.04, 0.04, 0.04)) for n, height in enumerate(heights)]
    cell = settled(shelf, *parts)
    for number, height in enumerate(heights):
        assert place(cell, f"A{number}")[2] == pytest.approx(0.01 + height + 0.02, abs=0.002)


@pytest.mark.parametrize(("x", "through"), [(0.1, True), (-0.1, False)])
def test_a_part_falls_through_the_opening_of_a_panel(x: float, through: bool) -> None:
    panel = body("Panel", at(0, 0, 0.3), (0.4, 0.2, 0.02), cls=FURNITURE, shape="panel")
    opening = [
        *body("Opening", at(0.1, 0, 0.3), (0.08, 0.08), cls=AREA),
        AddRelation(lab("Panel"), HAS_OPENING, lab("Opening")),
    ]
    cell = settled(panel, opening, body("A", at(x, 0, 0.33), (0.05, 0.05, 0.05)))
    assert place(cell)[2] == pytest.approx(0.025 if through else 0.325, abs=0.003)


def test_a_ball_lies_in_a_trough_that_is_a_mesh_and_on_its_hull(tmp_path: Path) -> None:
    pytest.importorskip("coacd", reason="the extra `meshes` is not installed")
    path, ball = write_obj(tmp_path / "u.obj", u_shape()), body("A", at(0, 0, 0.3), (0.06, 0.06, 0.06), shape="sphere")
    upright = Pose(np.array([0.0, 0.0, 0.1]), exp(np.array([radians(90), 0.0, 0.0])))
    for shape, height in (("mesh", 0.13), ("hull", 0.23)):
        trough = body("Trough", upright, (0.3, 0.2, 0.1), cls=LOCATION, shape=shape, mesh=path)
        assert place(settled(trough, ball))[2] == pytest.approx(height, abs=0.005), shape


def test_the_mass_is_what_is_stated() -> None:
    state = scene("panda_desk").with_changes(
        [*body("A", at(0, 0, 0.5), (0.1, 0.1, 0.1), density=300.0, centreOfMass="0 0 0.02")]
    )
    built = SimulatedCell(WorldModel(state))
    root = built.model.body(built.scene.names[lab("A")] + "/block")
    assert root.mass[0] == pytest.approx(0.3)
    assert root.ipos == pytest.approx([0, 0, 0.02])
