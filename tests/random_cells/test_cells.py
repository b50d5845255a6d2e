"""Random cells: drawn again alike, as users could have written them; none ends in a false success or a crash."""

from __future__ import annotations

from itertools import product
from pathlib import Path
from typing import get_args

import pytest

from random_cells.happening import DEEDS, Moment
from random_cells.outcomes import BAD, Outcome, classify, format_table
from random_cells.running import CaseRunner
from random_cells.spoiling import FAULTS, draw_case, draw_watched_case
from random_cells.writing import write_cell
from skillc_runtime.evaluation.trials.trial import Trial

SMALL = 1
"""How many parts are moved in the cells of this test: a cell with more takes long."""
ALL = 2 * len(FAULTS)
"""So many seeds have each trouble once, and as many cells without."""


def test_half_of_the_cells_can_be_solved_and_every_trouble_occurs() -> None:
    cases = [draw_case(seed) for seed in range(300)]
    assert sum(case.trouble == "none" for case in cases) == 150
    assert {case.trouble for case in cases[:ALL]} == {"none", *FAULTS}
    assert {len(case.believed.parts) for case in cases} >= set(range(1, 13))
    assert {case.believed.has_camera for case in cases} == {True, False}
    assert {len(case.believed.goal) for case in cases} >= set(range(1, 9))
    assert {len(case.believed.bins) for case in cases} == set(range(1, 7))
    assert {case.believed.arm for case in cases} == {"iiwa14", "ur5e", "panda"}
    assert {part.shape for case in cases for part in case.believed.parts} == {"box", "bar", "cylinder", "sphere"}


def test_in_watched_cells_everything_happens_at_every_moment() -> None:
    cases = [draw_watched_case(seed, SMALL) for seed in range(100)]
    happenings = [case.happening for case in cases if case.happening is not None]
    assert len(happenings) == 100 and all(case.believed.has_camera for case in cases)
    assert {(each.deed, each.moment) for each in happenings} == set(product(DEEDS, get_args(Moment)))
    assert [draw_watched_case(seed, SMALL) for seed in range(100)] == cases


def test_a_seed_writes_the_same_cell_again(tmp_path: Path) -> None:
    texts = []
    for name in ("one", "two"):
        write_cell(draw_case(7).believed, tmp_path / name / "cell_7")
        texts.append([(tmp_path / name / "cell_7" / file).read_bytes() for file in ("cell.ttl", "cell_7.skill")])
    assert texts[0] == texts[1]


@pytest.mark.parametrize(
    ("trial", "outcome"),
    [
        (Trial(seed=0, status="succeeded", verified=True, at_rest=True), "success, verified"),
        (Trial(seed=0, status="succeeded", verified=False, at_rest=True), "finished, not verified"),
        (Trial(seed=0, status="succeeded", verified=False, false_claims=("it lies elsewhere",)), "FALSE SUCCESS"),
        (Trial(seed=0, status="failed", reason="nothing is there", at_rest=True), "honest failure"),
        (Trial(seed=0, status="failed", reason="nothing is there", at_rest=False), "crash"),
        (Trial(seed=0, status="failed", reason='KeyError: "Invalid name"', at_rest=True), "crash"),
        (Trial(seed=0, status="refused", reason="it is too wide"), "refused before moving"),
        (Trial(seed=0, status="crashed", reason="the process died"), "crash"),
    ],
)
def test_the_outcome_of_a_cell(trial: Trial, outcome: Outcome) -> None:
    assert classify(trial) == outcome


def test_the_table_has_a_row_for_each_trouble_and_the_share_that_succeeded() -> None:
    trials = [Trial(seed=seed, status="succeeded", verified=True) for seed in (0, 1, 2)]
    trials.append(Trial(seed=4, status="failed", reason="nothing is there", at_rest=True))
    assert format_table(trials).endswith("2 of 3 solvable cells succeeded")
    assert [line.split("  ")[0] for line in format_table(trials).splitlines()[1:-1]] == ["none", "no support"]


@pytest.mark.slow
def test_a_cell_without_physics_is_solved(tmp_path: Path) -> None:
    trial = CaseRunner(tmp_path, "kinematic", SMALL).run(2)
    assert (trial.status, trial.verified, trial.false_claims) == ("succeeded", False, ()), trial.reason


@pytest.mark.slow
@pytest.mark.parametrize("has_camera", [False, True])
def test_a_displaced_part_is_grasped_where_a_camera_sees_it_and_else_not(tmp_path: Path, has_camera: bool) -> None:
    cases = (draw_case(seed, SMALL) for seed in range(1, 300, 2))
    case = next(each for each in cases if (each.trouble, each.believed.has_camera) == ("displaced", has_camera))
    trial = CaseRunner(tmp_path, "kinematic", SMALL).run(case.seed)
    assert classify(trial) == ("finished, not verified" if has_camera else "honest failure"), trial


@pytest.mark.sim
@pytest.mark.parametrize("seed", [0, 3, 29, 34])
def test_what_happens_while_a_camera_looks_is_noticed(seed: int, tmp_path: Path) -> None:
    trial = CaseRunner(tmp_path, "mujoco", SMALL, "watched").run(seed)
    assert classify(trial) not in BAD, trial


@pytest.mark.sim
@pytest.mark.parametrize("seed", range(ALL))
def test_a_cell_ends_as_it_should(seed: int, tmp_path: Path) -> None:
    trial = CaseRunner(tmp_path, "mujoco", SMALL).run(seed)
    assert classify(trial) not in BAD, trial
    if draw_case(seed, SMALL).trouble == "none":
        assert trial.status == "succeeded", trial.reason
