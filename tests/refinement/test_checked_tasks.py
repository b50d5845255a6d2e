"""`skillc check` looks at tasks in space before they run, says once what does not go, and remembers what it saw."""

import json
import re
from collections.abc import Sequence
from pathlib import Path

import pytest
from click.testing import CliRunner
from msgspec.structs import replace

import skillc_skills
from refinement.scenes import DESK, tilt_desk
from refinement.test_measured_values import PROBING
from skillc.cli.main import skillc
from skillc.services.check import known_checks
from skillc.services.library import answer_store as disk_store
from skillc.services.library.libraries import load_vocabulary
from skillc.services.space import look, verdicts
from skillc_runtime.cancellation import CancelToken
from skillc_runtime.execution.refinement.failure import SpaceFailure
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import POSITION
from skillc_skills import sorting
from waiting import LONG_S

CLEAN = """
use wiping
prefix lab: <http://example.org/lab#>
import "handling.skill"
import "wiping/wipe.skill"

task clean_door {
    scene "cell.ttl"
    goal  lab:Desk-1.isClean == true
}
"""
REACH = """
use skillc
prefix lab: <http://example.org/lab#>
import "motion.skill"

task reach {
    scene "cell.ttl"
    do seq {
        TakePosture(arm: lab:Panda-1)
        MoveTo(arm: lab:Panda-1, target: lab:Desk-1.pose)
    }
}
"""
VISIT = """
use skiros, rparts, skillc, wiping
import "motion.skill"

skill Visit {
    in   arm:   ArmDevice
    in   above: ApproachPose
    in   on:    WipeableSurface
    noplan
}

impl straight of Visit {
    do seq {
        MoveTo(arm, target: above.pose)
        MoveTo(arm, target: above.pose)
    }
}

skill Rest { noplan }
impl idle of Rest { do wait 1 s }
"""
VISITING = """
prefix lab: <http://example.org/lab#>
import "visit.skill"

task visit {
    scene "cell.ttl"
    do    Visit(arm: lab:Panda-1, above: lab:Eraser-1-approach, on: lab:Desk-1)
}
"""


def write(folder: Path, text: str, scene: str = DESK) -> Path:
    folder.mkdir(exist_ok=True)
    (folder / "tasks.skill").write_text(text)
    (folder / "cell.ttl").write_text(scene)
    return folder


def check(folder: Path, *options: str) -> tuple[list[dict], int]:
    ran = CliRunner().invoke(skillc, ["check", str(folder), "--json", *options])
    return json.loads(ran.stdout), ran.exit_code


def lines(found: dict) -> set[str]:
    """Return the lines to which a diagnostic points, as text."""
    places = [found, *found["labels"]]
    return {Path(each["path"]).read_text().splitlines()[each["line"] - 1] for each in places}


SORTING = (Path(sorting.__path__[0]) / "panda.ttl").read_text()
SORTING = SORTING.replace("sorting:WorkPart", "skiros:Product").replace("sorting:Box", "skiros:Container")
SORT = """
use skiros
prefix lab: <http://example.org/lab#>
import "handling.skill"

task sort {
    scene "cell.ttl"
    goal  lab:Box-A contain lab:Part-A
}
"""

DOOR = {"X": 0.45, "Z": 0.75}
"""Where the door is, in m."""


def move(place: dict[str, float], told: str) -> dict[str, float]:
    """Return a place with what a cure says."""
    found = re.fullmatch(r"with lab:Desk-1 moved by 0\.\d+ m, to Position([XZ]) (0\.\d+), all steps go", told)
    assert found is not None, told
    return {**place, found[1]: float(found[2])}


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Give this test entries of its own in the cache, which nothing but what is checked invalidates."""
    monkeypatch.setattr(disk_store, "installation_digest", lambda: str(tmp_path).encode())


@pytest.mark.slow
def test_a_door_at_which_a_joint_would_leave_its_range_is_told_at_the_task_and_the_door(tmp_path, own):
    folder = write(tmp_path / "door", CLEAN, tilt_desk(0.45, -20.0, 0.75))
    (found,), code = check(folder)
    assert (found["name"], found["severity"], code) == ("infeasible-step", "error", 1)
    assert "Wipe(lab:Desk-1) does not go: FollowPath: lab:Panda-1: joint 4 would be at -3." in found["message"]
    assert {line.split(" a ")[0] for line in lines(found)} == {"task clean_door {", "lab:Desk-1", "lab:Panda-1"}
    moved = move(DOOR, found["help"])
    assert moved != DOOR
    for x in (moved["X"], moved["X"] - look.ROOM_M, moved["X"] + look.ROOM_M):
        write(folder, CLEAN, tilt_desk(x, -20.0, moved["Z"]))
        assert check(folder)[1] == 0


@pytest.mark.slow
def test_a_surface_that_goes_only_where_the_scene_has_it_is_told_with_the_joint(tmp_path, incurable):
    """A run measures where it is, and fails where a joint would leave its range: three of three trials did.

    It goes where the scene has it, if only in another posture than the nearest to home.
    """
    folder = write(tmp_path / "board", CLEAN, tilt_desk(0.5, -20.0, 0.75))
    (found,), code = check(folder)
    assert (found["name"], found["severity"], code) == ("infeasible-step", "warning", 0)
    assert "but not everywhere within its offsetRange and tiltRange: -16 mm along its z axis and" in found["message"]
    assert "joint 7 would be at -2.95, outside its range from -2.90 to 2.90" in found["message"]
    assert {line.split(" a ")[0] for line in lines(found)} >= {"task clean_door {", "lab:Desk-1"}
    assert check(write(folder, CLEAN, tilt_desk(0.4, 20.0, 0.75))) == ([], 0), "all of three trials went"


def test_what_is_in_the_way_is_moved_before_what_the_step_is_given(tmp_path):
    (tmp_path / "cell.ttl").write_text(DESK)
    state = load_scene(tmp_path / "cell.ttl", load_vocabulary())
    eraser, desk = map(state.vocabulary.expand, ("lab:Eraser-1", "lab:Desk-1"))
    before_m = state.value(desk, POSITION[0])
    touching = SpaceFailure("in-the-way", "where it shall go lab:Eraser-1 would touch lab:Desk-1")

    def goes(changes: Sequence[SetProperty]) -> bool:
        return WorldModel(state).commit(list(changes)).after.value(desk, POSITION[0]) > before_m + 0.12

    cured = look.find_cure(state, [eraser], touching, goes, CancelToken())
    assert cured == f"with lab:Desk-1 moved by 0.15 m, to PositionX {before_m + 0.15:g}, all steps go"
    far = replace(touching, cause="out-of-reach")
    assert look.find_cure(state, [eraser], far, goes, CancelToken()) == "", "no eraser helps there"


@pytest.mark.slow
def test_a_call_in_a_body_that_does_not_go_is_told_at_the_call(tmp_path):
    (found,), code = check(write(tmp_path / "reach", REACH), "--no-cache")
    assert (found["name"], found["severity"], code) == ("infeasible-step", "error", 1)
    assert "would touch lab:Desk-1" in found["message"]
    assert "        MoveTo(arm: lab:Panda-1, target: lab:Desk-1.pose)" in lines(found)


@pytest.mark.slow
def test_a_box_without_room_is_an_error_for_a_task_that_has_no_other_way(tmp_path, incurable):
    """Alone it is a warning: only what stands there now is in the way. A look knows that nothing can move that."""
    lump = """
lab:Cell skiros:contain lab:Lump .
lab:Lump a skillc:Furniture ; skiros:SizeX 0.12 ; skiros:SizeY 0.12 ; skiros:SizeZ 0.04 ; skillc:on lab:Box-A .
"""
    folder = write(tmp_path / "full", SORT, SORTING + lump)
    (found,), code = check(folder)
    assert (found["name"], found["severity"], code) == ("no-room", "error", 1)
    assert "is clear of lab:Lump" in found["message"]
    assert "task sort {" in lines(found)


@pytest.mark.slow
def test_a_goal_that_the_manifest_names_is_looked_at_and_its_scene_counts(tmp_path, own, incurable):
    folder = write(tmp_path / "door", CLEAN[: CLEAN.index("task")], tilt_desk(0.45, -20.0, 0.75))
    named = '[tasks.clean]\ngoal = "lab:Desk-1.isClean == true"\n'
    (folder / "skillc.toml").write_text(f'name = "door"\nscene = "cell.ttl"\n{named}')
    told = [each for each in check(folder)[0] if each["name"] == "infeasible-step"]
    assert [Path(each["path"]).name for each in told] == ["skillc.toml"]
    (folder / "cell.ttl").write_text(tilt_desk(0.4, 20.0, 0.75))
    assert not [each for each in check(folder)[0] if each["name"] == "infeasible-step"]


@pytest.mark.slow
def test_a_value_that_only_a_run_will_measure_is_no_problem(tmp_path):
    assert check(write(tmp_path / "probing", PROBING), "--no-cache") == ([], 0)


@pytest.mark.slow
def test_what_was_seen_is_not_looked_at_again_until_something_changes_that_it_depends_on(tmp_path, own, monkeypatch):
    folder, looks = write(tmp_path / "reach", REACH), []
    look_at_task = look.look_at_task
    monkeypatch.setattr(look, "look_at_task", lambda *arguments: looks.append(1) or look_at_task(*arguments))
    first = check(folder)
    assert check(folder) == first
    write(folder, REACH.replace("task reach", "# moved\n\ntask reach"))
    (moved,), _ = check(folder)
    assert len(looks) == 1
    assert moved["line"] == first[0][0]["line"] + 2
    low = REACH.replace("Desk-1.pose", "Eraser-1-approach.pose")
    write(folder, low)
    assert check(folder) == ([], 0)
    assert len(looks) == 2
    write(
        folder,
        low,
        DESK.replace("PositionX 0.4 ; skiros:PositionY -0.45", "PositionX 0.42 ; skiros:PositionY -0.45"),
    )
    check(folder)
    assert len(looks) == 3


@pytest.mark.slow
def test_after_an_edit_of_a_body_only_those_are_looked_at_that_it_concerns(tmp_path, own, incurable, monkeypatch):
    folder, looks = write(tmp_path / "visit", VISITING), []
    look_at_task = look.look_at_task
    monkeypatch.setattr(look, "look_at_task", lambda *arguments: looks.append(1) or look_at_task(*arguments))

    def told(text: str) -> list[str]:
        (folder / "visit.skill").write_text(text)
        return [each["message"] for each in check(folder)[0] if each["name"] == "infeasible-step"]

    assert told(VISIT) == []
    assert told(VISIT.replace("wait 1 s", "wait 2 s")) == []
    assert told(f"{VISIT}\nskill Look {{ noplan }}\nimpl around of Look {{ do wait 1 s }}\n") == []
    assert len(looks) == 1
    (message,) = told(VISIT.replace("above.pose)\n    }", "on.pose)\n    }"))
    assert message.startswith("Visit does not go in space: MoveTo: where it shall go")
    assert len(looks) == 2


@pytest.mark.slow
def test_an_edit_beside_a_task_has_only_its_file_checked_again(tmp_path, own, incurable, monkeypatch):
    beside = "\nskill Look { noplan }\nimpl around of Look { do wait 1 s }\n"
    folder, wholes = write(tmp_path / "visit", VISITING + beside, tilt_desk(0.45, -20.0, 0.75)), []
    (folder / "visit.skill").write_text(VISIT.replace("above.pose)\n    }", "on.pose)\n    }"))
    check_whole = known_checks._check_whole
    monkeypatch.setattr(known_checks, "_check_whole", lambda *given: wholes.append(1) or check_whole(*given))
    first = check(folder)
    assert "infeasible-step" in {each["name"] for each in first[0]}
    (folder / "tasks.skill").write_text(VISITING + beside.replace("1 s", "2 s"))
    assert check(folder) == first
    assert len(wholes) == 1
    assert check(folder, "--no-cache") == first
    (folder / "tasks.skill").write_text(VISITING.replace("Eraser-1-approach", "Panda-1") + beside)
    assert check(folder) != first
    assert len(wholes) == 3


@pytest.mark.slow
def test_a_task_for_which_there_is_no_time_is_noted_and_nothing_is_remembered(tmp_path, own, incurable, monkeypatch):
    folder = write(tmp_path / "door", CLEAN, tilt_desk(0.45, -20.0, 0.75))
    monkeypatch.setattr(verdicts, "LIMIT_S", 0.0)
    (note,), code = check(folder)
    assert (note["name"], note["severity"], code) == ("unchecked-space", "note", 0)
    assert "`clean_door` was not looked at in space" in note["message"]
    monkeypatch.setattr(verdicts, "LIMIT_S", LONG_S)
    assert check(folder)[1] == 1


@pytest.mark.slow
@pytest.mark.parametrize("library", ["wiping", "contact", "sorting"])
def test_shipped_tasks_go(library):
    assert check(Path(skillc_skills.__path__[0]) / library, "--no-cache") == ([], 0)
