"""Where a thing is put down is chosen: the nearest place from which all goes; the run takes the place of its plan."""

import json
from collections.abc import Iterator
from itertools import islice
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from bodies.test_shelves import held, shelf_on_table
from bodies.test_trays import PART
from refinement.mat_cell import write_mat
from skillc.cli.main import skillc
from skillc_runtime.world.space.placing.free_places import FreePlace, list_free_places
from skillc_runtime.world.space.placing.place_sampling import APART_M
from space.rooms import lab

ON_MAT = "lab:Mat contain lab:Part-A"
BOTH = f"{ON_MAT} and lab:Mat contain lab:Part-B"
RESERVED = """
lab:Mat skiros:hasA lab:Spot .
lab:Spot a skiros:PlacingPose ; skillc:reservedFor lab:Part-{part} ; skillc:roll 180 ;
    skiros:BaseFrameId "map" ; skiros:PositionX 0.6 ; skiros:PositionY 0.15 ; skiros:PositionZ 0.604 .
"""
"""A place on the mat for one part."""


def ask(command: str, scene: Path, goal: str, *options: str) -> dict:
    asked = [command, "--library", "sorting", "--scene", str(scene), "--goal", goal, "--json", *options]
    return json.loads(CliRunner().invoke(skillc, asked).stdout)


def plan_places(scene: Path, goal: str) -> list[dict]:
    space = ask("plan", scene, goal, "--no-plan-cache")["space"]
    assert space["failure"] is None and space["checked"] == space["steps"]
    return space["places"]


def iterate_on_rack() -> Iterator[FreePlace]:
    return list_free_places(held(*shelf_on_table(0.45, 2)), lab("Panda-1"), lab("Hand-1"), PART, lab("Rack"))


@pytest.mark.slow
def test_places_begin_where_things_are_put_without_a_choice_and_are_spread_over_the_supports() -> None:
    found = list(iterate_on_rack())
    top = [each.hand for each in found if each.support.board == 0]
    assert len(top) > 10
    assert np.allclose(top[0].position[:2], (0.55, 0.2), atol=0.01), "its middle"
    for each in found:
        away = each.support.middle.inverse().apply(each.hand.position)
        assert (np.abs(away[:2]) <= each.support.half - 0.02 + 1e-9).all(), "all of the part of 4 cm is on it"
    for number, each in enumerate(top):
        for other in top[:number]:
            turned = np.abs(each.rotation - other.rotation).max() > 0.5
            assert turned or np.linalg.norm(each.position - other.position) >= APART_M - 1e-9
    assert max(np.linalg.norm(each.position - top[0].position) for each in top) > 0.15
    again = islice(iterate_on_rack(), 10)
    assert [each.hand.position.tolist() for each in again] == [each.hand.position.tolist() for each in found[:10]]


@pytest.mark.slow
def test_without_anything_in_the_way_the_middle_is_taken(tmp_path: Path) -> None:
    (place,) = plan_places(write_mat(tmp_path, pillar=False), ON_MAT)
    assert (place["step"], place["thing"], place["place"], place["support"]) == (2, "lab:Part-A", "lab:Mat", "lab:Mat")
    assert np.allclose(place["at"]["position_m"][:2], (0.0, 0.0), atol=1e-6)


@pytest.mark.slow
def test_where_the_arm_would_touch_something_another_place_is_chosen_and_the_run_takes_it(tmp_path: Path) -> None:
    scene = write_mat(tmp_path, pillar=True)
    (place,) = plan_places(scene, ON_MAT)
    x_m, y_m, _ = place["at"]["position_m"]
    assert 0.02 < np.hypot(x_m, y_m) < 0.15, "not the middle, but near it"
    result = ask("run", scene, ON_MAT, "--no-film", "--backend", "kinematic", "--out", str(tmp_path / "run"))
    assert (result["status"], result["failure"]) == ("succeeded", None)
    (taken,) = result["plan_in_space"]["places"]
    assert taken["at"] == place["at"] and taken["at"]["frame"] == "lab:Mat"
    (put,) = result["placements"]
    assert np.allclose(put["true_m"][:2], (0.65 + x_m, y_m), atol=0.005)
    told = CliRunner().invoke(skillc, ["why", str(tmp_path / "run")]).stdout
    assert f"lab:Part-A is put down at ({x_m:.2f}, {y_m:.2f}) m from the middle of lab:Mat" in told
    again = CliRunner().invoke(skillc, ["replay", str(tmp_path / "run"), "--check"])
    assert again.exit_code == 0 and "the same but for wall times" in again.output


@pytest.mark.slow
def test_a_second_part_goes_beside_the_first_one(tmp_path: Path) -> None:
    one, other = plan_places(write_mat(tmp_path, pillar=True), BOTH)
    assert {one["thing"], other["thing"]} == {"lab:Part-A", "lab:Part-B"}
    apart = np.array(one["at"]["position_m"]) - np.array(other["at"]["position_m"])
    assert np.abs(apart[:2]).max() > 0.04, "the parts are 4 cm wide"


@pytest.mark.slow
@pytest.mark.parametrize(("part", "there"), [("A", True), ("B", False)])
def test_a_place_is_kept_for_the_thing_for_which_it_is_reserved(part: str, there: bool, tmp_path: Path) -> None:
    scene = write_mat(tmp_path, False, RESERVED.format(part=part))
    (place,) = plan_places(scene, ON_MAT)
    assert (place["support"] == "lab:Spot", place["stated"]) == (there, there)


@pytest.mark.sim
def test_in_physics_the_part_stands_where_the_plan_put_it(tmp_path: Path) -> None:
    scene = write_mat(tmp_path, pillar=True)
    result = ask("run", scene, ON_MAT, "--no-film", "--out", str(tmp_path / "run"))
    assert (result["status"], result["failure"], result["touches"]) == ("succeeded", None, [])
    (place,) = result["plan_in_space"]["places"]
    x_m, y_m, _ = place["at"]["position_m"]
    (put,) = result["placements"]
    assert np.hypot(x_m, y_m) > 0.02
    assert np.allclose(put["true_m"][:2], (0.65 + x_m, y_m), atol=0.01)
