"""What a look in space says of random surfaces is so: those that go are wiped, those that do not have no way at all."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from judged_looks.looking import look, make_ideal_cell
from judged_looks.verdict import Verdict, format_table, share_that_is_so
from random_cells.drawing import ArmName
from random_surfaces.dense_search import RADIUS_M, STEP_M, DenseSearch, wiping_path
from random_surfaces.drawing import ARM_NAMES, THICK_M, Surface, draw_crowded_surface, draw_surface, format_scene
from random_surfaces.judging import judge, load_surface


def search(surface: Surface, folder: Path) -> np.ndarray | None:
    return DenseSearch(make_ideal_cell(load_surface(surface, folder / "cell.ttl")), surface).solves()


def test_a_seed_draws_the_same_surface_again_and_all_are_different() -> None:
    drawn = [draw_surface(seed, arm) for seed in range(20) for arm in ARM_NAMES]
    assert drawn == [draw_surface(seed, arm) for seed in range(20) for arm in ARM_NAMES]
    assert len(set(map(format_scene, drawn))) == 60
    assert all(0.2 <= side <= 0.8 for each in drawn for side in each.size)
    standing = [abs(each.rotation[2, 2]) < 0.7 for each in drawn]
    assert any(standing) and not all(standing)


def test_boxes_around_a_surface_neither_lie_in_it_nor_where_the_arm_stands() -> None:
    drawn = [draw_crowded_surface(seed) for seed in range(20)]
    assert drawn == [draw_crowded_surface(seed) for seed in range(20)]
    assert all(1 <= len(each.boxes) <= 3 and format_scene(each).count("lab:Box-1") == 2 for each in drawn)
    for surface in drawn:
        for box in surface.boxes:
            middle = np.array(box.at) - np.array([0.0, 0.0, box.size[2] / 2])
            x, y, z = (middle - surface.at) @ surface.rotation
            inside = abs(x) < surface.size[0] / 2 and abs(y) < surface.size[1] / 2 and -THICK_M < z < 0
            assert not inside and np.hypot(*box.at[:2]) > 0.2


def test_the_path_that_is_searched_comes_near_every_point_of_the_surface_and_has_no_gaps() -> None:
    for surface in (draw_surface(seed, "panda") for seed in range(5)):
        path = np.array([each.position for each in wiping_path(surface)])
        local = (path - surface.at) @ surface.rotation
        assert np.linalg.norm(np.diff(local, axis=0), axis=1).max() < STEP_M + 2 * RADIUS_M + 1e-9
        x, y = np.meshgrid(*(np.linspace(-each / 2, each / 2, 7) for each in surface.size))
        points = np.column_stack([x.ravel(), y.ravel(), np.zeros(49)])
        assert max(np.linalg.norm(local - each, axis=1).min() for each in points) < 0.07


def test_the_table_counts_what_is_so() -> None:
    verdicts = [Verdict(seed, "panda", "no", seed > 0, "") for seed in range(4)]
    assert share_that_is_so(verdicts, "no") == 0.75
    assert share_that_is_so(verdicts, "yes") == 1.0
    assert format_table(verdicts).splitlines()[1].split() == ["panda", "no", "4", "3"]


@pytest.mark.sim
@pytest.mark.parametrize(
    ("seed", "arm", "said"),
    [
        (0, "iiwa14", "no"),
        (1, "iiwa14", "no"),
        (0, "ur5e", "yes"),
        (3, "ur5e", "yes"),
        (0, "panda", "no"),
        (1, "panda", "yes"),
        (46, "panda", "yes"),
    ],
)
def test_what_is_said_of_wiping_a_surface_is_so(seed: int, arm: ArmName, said: str, tmp_path: Path) -> None:
    verdict = judge(seed, arm, tmp_path)
    assert (verdict.said, verdict.is_so) == (said, True), verdict.why


@pytest.mark.slow
@pytest.mark.parametrize("seed", [38, 71, 113])
def test_many_postures_are_looked_at(seed: int, tmp_path: Path) -> None:
    """One surface goes near a singularity, the others from a posture with the elbow elsewhere."""
    task = load_surface(draw_surface(seed, "panda"), tmp_path / "cell.ttl")
    assert look(task) == ("yes", "")


@pytest.mark.slow
def test_what_a_palm_touches_before_it_wipes_it_may_not_press_into(tmp_path: Path) -> None:
    """The palm overlaps a box by 0.4 mm above the surface, and by 15 mm on a lane; the run ended with a fault."""
    said, why = look(load_surface(draw_crowded_surface(9), tmp_path / "cell.ttl"))
    assert said == "no" and "lab:Hand-1 would touch lab:Box-1 and overlap it by 15 mm" in why


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "arm"), [(6, "ur5e"), (30, "ur5e")])
def test_the_hand_counts_in_what_an_arm_reaches(seed: int, arm: ArmName, tmp_path: Path) -> None:
    assert look(load_surface(draw_surface(seed, arm), tmp_path / "cell.ttl")) == ("yes", "")


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "arm"), [(0, "ur5e"), (1, "panda")])
def test_the_search_finds_a_way_to_wipe_what_can_be_wiped_and_none_out_of_reach(
    seed: int, arm: ArmName, tmp_path: Path
) -> None:
    surface = draw_surface(seed, arm)
    assert search(surface, tmp_path) is not None
    x, y, z = surface.at
    assert search(replace(surface, at=(x + 0.6, y + 0.6, z)), tmp_path) is None
