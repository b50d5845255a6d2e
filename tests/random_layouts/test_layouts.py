"""What a look in space says of random layouts is so: what it says can be moved is, and else there is no way."""

from __future__ import annotations

from pathlib import Path

import pytest

from judged_looks.looking import look, make_ideal_cell
from judged_looks.verdict import Verdict, share_solved
from random_layouts.drawing import KINDS, draw_layout, format_layout
from random_layouts.exhaustive import find_way
from random_layouts.judging import judge, write_layout
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.tasks.loading import load_task
from skillc_runtime.execution.assignment import PreparedTask
from skillc_runtime.execution.refinement.run_planning import SpaceLook
from skillc_runtime.execution.refinement.scope import call_of
from skillc_runtime.execution.refinement.situation import begin_at_home
from skillc_runtime.execution.refinement.walk import Scope, Walk
from skillc_runtime.execution.task_planning import prepare_task
from skillc_runtime.planning.plan import Step
from skillc_runtime.recording.run_spec import RunSpec


def test_a_seed_draws_the_same_layout_again_and_all_are_different() -> None:
    drawn = [draw_layout(seed, kind) for seed in range(10) for kind in KINDS]
    assert drawn == [draw_layout(seed, kind) for seed in range(10) for kind in KINDS]
    assert len({format_layout(each, "cell") for each in drawn}) == 10 * len(KINDS)
    assert {each.arms for each in drawn} == {1, 2}


def test_what_is_said_not_to_go_and_goes_counts_as_not_solved() -> None:
    said = [("yes", True), ("yes", True), ("no", True), ("no", False), ("unknown", None)]
    verdicts = [Verdict(seed, "plain", *each, "") for seed, each in enumerate(said)]
    assert share_solved(verdicts) == pytest.approx(2 / 3)


def test_bases_have_a_way_between_stations_and_racks_have_a_board_above_the_part() -> None:
    bases = [draw_layout(seed, "bases") for seed in range(10)]
    assert all(
        2 <= len(each.stations) <= 3 and "lab:Station-1 a skillc:Workstation" in format_layout(each, "cell")
        for each in bases
    )
    racks = [draw_layout(seed, "rack").cell for seed in range(10)]
    assert all(each.boxes[0][2][2] > each.parts[0].at[2] + each.parts[0].size[2] / 2 for each in racks)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("seed", "kind", "way"),
    [
        (0, "plain", "Part-1 into Bin-1 with 1"),
        (0, "stack", "Part-2 into Bin-1 with 1, Part-1 into Bin-1 with 1"),
        (3, "two-arms", None),
    ],
)
def test_the_search_takes_what_is_above_first_and_finds_nothing_out_of_reach(
    seed: int, kind: str, way: str | None, tmp_path: Path
) -> None:
    layout = draw_layout(seed, kind)
    with load_task(RunSpec(task=write_layout(layout, tmp_path / "drawn")), SilentReporter()) as task:
        assert find_way(make_ideal_cell(task), layout) == way


@pytest.mark.slow
def test_a_part_for_a_narrow_slot_is_taken_by_its_top(tmp_path: Path) -> None:
    name = write_layout(draw_layout(5, "slot"), tmp_path / "drawn")
    with load_task(RunSpec(task=name), SilentReporter()) as task:
        prepared = prepare_task(task.assignment, task.library, look=SpaceLook())
    assert isinstance(prepared, PreparedTask) and prepared.space is not None
    assert [(each.step, each.implementation) for each in prepared.space.implementations] == [(1, "by_top")]


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "kind"), [(9, "two-arms"), (31, "bases"), (206, "crowd")])
def test_another_place_or_part_is_found_where_the_first_one_does_not_go(seed: int, kind: str, tmp_path: Path) -> None:
    """In the middle of the bin the elbow would be bent too far; where the base is wanted it has no room to turn.

    Of the two parts that keep the hand from a third one, one cannot be taken, but the other can.
    """
    name = write_layout(draw_layout(seed, kind), tmp_path / "drawn")
    with load_task(RunSpec(task=name), SilentReporter()) as task:
        assert look(task) == ("yes", "")


@pytest.mark.slow
def test_what_lies_on_a_part_is_no_reason_to_try_other_postures(tmp_path: Path) -> None:
    devices = {"arm": "Arm-1", "object": "Part-2", "robot": "Robot-1", "gripper": "Hand-1", "from": "Cell"}
    pick = Step("Pick", {name: f"http://example.org/lab#{each}" for name, each in devices.items()})
    with load_task(RunSpec(task=write_layout(draw_layout(5, "stack"), tmp_path / "drawn")), SilentReporter()) as task:
        walk = Walk(task.library)
        begin = begin_at_home(task.assignment.state)
        assert next(walk.go(call_of(pick, task.library), begin, Scope({})), None) is None
    lying = [each.within for each in walk.failures if each.why.startswith("lab:Part-3 lies on lab:Part-2")]
    assert lying and len(lying) <= len(task.library.skills["Pick"].implementations), "one for each way to pick"


@pytest.mark.sim
@pytest.mark.parametrize(
    ("seed", "kind", "said"),
    [
        (0, "bases", "yes"),
        (1, "stack", "yes"),
        (0, "crowd", "yes"),
        (0, "opposite", "yes"),
        (5, "slot", "yes"),
        (3, "shelf", "no"),
        (0, "two-arms", "yes"),
    ],
)
def test_what_is_said_of_moving_a_part_is_so(seed: int, kind: str, said: str, tmp_path: Path) -> None:
    """In the slot there is room for fingers that hold the part by its top."""
    verdict = judge(seed, kind, tmp_path)
    assert (verdict.said, verdict.is_so) == (said, True), verdict.why
