"""What does not go in space is planned around: what stands on a part is moved away first, and not into its place."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc
from skillc.services.planning.planning import plan_goal, prepare_planners
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.tasks.loading import load_task
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.refinement.replanning import plan_in_space
from skillc_runtime.planning.plan import GaveUp
from skillc_runtime.recording.run_spec import RunSpec
from skillc_skills import sorting

CELL = (Path(sorting.__path__[0]) / "panda.ttl").read_text()
PART_B = "skillc:on lab:Table ; skillc:atX 0.0 ; skillc:atY -0.2 ."
PART_A = "skillc:on lab:Table ; skillc:atX -0.05 ; skillc:atY -0.35 ."


def plan(folder: Path, *replaced: tuple[str, str]) -> dict:
    text = CELL
    for old, new in replaced:
        assert old in text
        text = text.replace(old, new)
    (folder / "cell.ttl").write_text(text)
    asked = ["--library", "sorting", "--scene", str(folder / "cell.ttl"), "--goal", "lab:Box-A contain lab:Part-A"]
    return json.loads(CliRunner().invoke(skillc, ["plan", *asked, "--json", "--no-plan-cache"]).stdout)


def steps(answer: dict) -> list[tuple[str, str]]:
    return [(each["skill"], each["arguments"]["object"]) for each in answer["plan"]]


@pytest.mark.slow
def test_what_stands_on_a_part_is_moved_away_first_and_not_to_where_the_part_shall_go(tmp_path):
    answer = plan(tmp_path, (PART_B, "skillc:on lab:Part-A ."))
    assert steps(answer) == [
        ("Pick", "lab:Part-B"),
        ("Place", "lab:Part-B"),
        ("Pick", "lab:Part-A"),
        ("Place", "lab:Part-A"),
    ]
    assert answer["plan"][1]["arguments"]["to"] == "lab:Box-B"
    assert answer["space"]["checked"] == 4
    assert answer["space"]["failure"] is None
    assert answer["optimal"] == "optimal for the filtered problem"
    why = [each["why"] for each in answer["left_out"] if each["kind"] == "steps"]
    assert "lab:Part-B is in the way of lab:Hand-1 around lab:Part-A" in why[0]
    assert "lab:Box-A is full" in why[1]


@pytest.mark.slow
def test_a_pile_is_taken_from_its_top(tmp_path):
    """What lies on a part is not lifted with it, though a hand could take the part from the side."""
    more = """
lab:Cell skiros:contain lab:Part-C, lab:Tray .
lab:Part-C a sorting:WorkPart ; skiros:SizeX 0.03 ; skiros:SizeY 0.03 ; skiros:SizeZ 0.04 ; skiros:Weight 0.1 ;
    skillc:on lab:Part-B .
lab:Tray a sorting:Box ; skiros:SizeX 0.26 ; skiros:SizeY 0.26 ; skiros:SizeZ 0.05 ;
    skillc:on lab:Table ; skillc:atX 0.12 ; skillc:atY 0.0 .
"""
    answer = plan(tmp_path, (PART_B, "skillc:on lab:Part-A ." + more))
    assert [thing for skill, thing in steps(answer) if skill == "Pick"] == ["lab:Part-C", "lab:Part-B", "lab:Part-A"]
    assert answer["space"]["checked"] == 6
    why = " ".join(each["why"] for each in answer["left_out"] if each["kind"] == "steps")
    assert "lab:Part-C lies on lab:Part-B" in why


@pytest.mark.slow
def test_what_is_in_the_way_may_be_put_elsewhere_in_the_place_that_it_is_in(tmp_path):
    lid = """
lab:Cell skiros:contain lab:Lid .
lab:Lid a sorting:WorkPart ; skiros:SizeX 0.17 ; skiros:SizeY 0.06 ; skiros:SizeZ 0.02 ; skiros:Weight 0.2 ;
    skiros:BaseFrameId "map" ; skiros:PositionX 0.45 ; skiros:PositionY 0.15 ; skiros:PositionZ 0.67 .
"""
    answer = plan(tmp_path, (PART_A, PART_A + lid))
    assert steps(answer) == [(skill, thing) for thing in ("lab:Lid", "lab:Part-A") for skill in ("Pick", "Place")]
    assert answer["plan"][1]["arguments"]["to"] == "lab:Cell"
    assert answer["space"]["checked"] == 4


@pytest.mark.slow
def test_a_part_that_stands_free_is_taken_at_once_and_the_plan_stays_proved(tmp_path):
    answer = plan(tmp_path)
    assert steps(answer) == [("Pick", "lab:Part-A"), ("Place", "lab:Part-A")]
    assert answer["optimal"] == "proven"


@pytest.mark.slow
def test_what_nobody_can_move_leaves_no_plan_and_the_cause_is_said(tmp_path):
    roof = """
lab:Roof a skillc:Furniture ; skiros:SizeX 0.2 ; skiros:SizeY 0.2 ; skiros:SizeZ 0.02 ;
    skiros:FrameId "roof" ; skiros:BaseFrameId "map" ;
    skiros:PositionX 0.45 ; skiros:PositionY -0.35 ; skiros:PositionZ 0.72 .
lab:Cell skiros:contain lab:Roof .
"""
    beside = PART_B.replace("atX 0.0 ; skillc:atY -0.2", "atX 0.01 ; skillc:atY -0.35")
    for around in (PART_B, beside):
        answer = plan(tmp_path, (PART_A, PART_A + roof), (PART_B, around))
        assert answer["status"] != "solved"
        assert "lab:Part-A" in answer["failure"] and "lab:Roof" in answer["failure"]
        assert "lab:Part-B" not in answer["failure"], "the roof is there also without what stands beside the part"


@pytest.mark.slow
def test_a_plan_that_does_not_go_is_no_answer_when_the_time_is_up(tmp_path):
    text = CELL.replace(PART_B, "skillc:on lab:Part-A .")
    (tmp_path / "cell.ttl").write_text(text)
    spec = RunSpec(library="sorting", scene=str(tmp_path / "cell.ttl"), goal="lab:Box-A contain lab:Part-A")
    with load_task(spec, SilentReporter()) as task:
        cancel, planners, asked = CancelToken(60.0), prepare_planners(False), list[int]()

        def plan_once(without):
            asked.append(len(without))
            if without:
                cancel.cancel("it was stopped")
                return GaveUp("it was stopped")
            return plan_goal(task, planners, cancel)

        answer, _ = plan_in_space(task.library, task.assignment.state, plan_once, cancel)
    assert asked == [0, 1] and isinstance(answer, GaveUp)
    assert answer.why.startswith(
        "it was stopped before one was found that the arms can carry out; of the last one: Pick("
    )
    assert "lab:Part-B is in the way" in answer.why


@pytest.mark.slow
def test_a_pile_is_taken_from_its_top_also_where_many_parts_stand_around(tmp_path):
    """Of forty parts one is in the way, and the step is not excluded for good."""
    more = "".join(
        f"""
lab:Cell skiros:contain lab:Other-{number} .
lab:Other-{number} a sorting:WorkPart ; skiros:SizeX 0.03 ; skiros:SizeY 0.03 ; skiros:SizeZ 0.04 ; skiros:Weight 0.1 ;
    skiros:BaseFrameId "map" ; skiros:PositionX -1.0 ; skiros:PositionY {0.1 * number:.1f} ; skiros:PositionZ 0.02 .
"""
        for number in range(40)
    )
    answer = plan(tmp_path, (PART_B, "skillc:on lab:Part-A ." + more))
    assert [thing for skill, thing in steps(answer) if skill == "Pick"] == ["lab:Part-B", "lab:Part-A"]
    assert answer["space"]["checked"] == 4
