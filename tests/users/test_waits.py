"""Two presses in a hall: who needs one that is in use waits for it, in one task and between operations."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from execution.loops import LatePlanner, Watched, submit
from skillc.cli.main import skillc
from skillc.services.library import libraries
from skillc.services.library.files import find_library
from skillc_model.declared import act_as_declared
from skillc_runtime.backends.symbolic.cell import SymbolicCell
from skillc_runtime.execution.assignment import Assignment, ExecuteBody
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.recording.commands import PauseRun, Resume, Stop
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel

LIBRARY = """\
use skiros, skillc
prefix lab: <http://example.org/lab#>

class    Press < Location
class    Blank < Product
relation next(Press, Press)
property isFlat(Blank): Bool

## Flatten `part` in a press that needs no hand.
skill Flatten {
    in   part:  Blank
    in   press: Press
    post part.isFlat == true
    duration 10 s
    uses press
    noplan
}

## Flatten `part` in any press.
skill FlattenSomewhere {
    in        part:  Blank
    infer any press: Press
    pre  press next _
    post part.isFlat == true
    duration 10 s
    uses press
    noplan
}

## Bend `part`, once it is flat.
skill Bend {
    in   part:  Blank
    in   press: Press
    pre  part.isFlat == true
    duration 3 s
    uses press
    noplan
}

## Have `robot` put `part` into `press`, and wait beside it.
skill Serve {
    in   robot: MobileRobot
    in   part:  Blank
    in   press: Press
    post part.isFlat == true
    uses robot
    noplan
}

impl by_robot of Serve {
    do seq {
        Flatten(part, press)
        wait 5 s
    }
}

## Clean `press`, with a part in the one beside it.
skill Clean {
    in    press: Press
    in    part:  Blank
    infer other: Press
    pre   press next other
    post  part.isFlat == true
    uses  press
    noplan
}

impl with_next of Clean {
    do seq {
        wait 1 s
        Flatten(part, press: other)
    }
}

skill CleanBoth {
    in one:   Press
    in other: Press
    in part:  Blank
    post part.isFlat == true
    noplan
}

impl at_once of CleanBoth {
    do par all {
        Clean(press: one, part)
        Clean(press: other, part)
    } on failure as why {
        fail "not clean: {why}"
    }
}

test both_are_flat_one_after_the_other {
    scene  "hall.ttl"
    do par all {
        Flatten(part: lab:Part-1, press: lab:Press-1)
        Flatten(part: lab:Part-2, press: lab:Press-1)
    }
    expect lab:Part-1.isFlat == true and lab:Part-2.isFlat == true
}

test three_parts_take_the_time_of_two {
    scene  "hall.ttl"
    do par all {
        FlattenSomewhere(part: lab:Part-1)
        FlattenSomewhere(part: lab:Part-2)
        FlattenSomewhere(part: lab:Part-3)
    }
    expect lab:Part-3.isFlat == true
}

test a_time_out_ends_a_wait {
    scene  "hall.ttl"
    do par all {
        Flatten(part: lab:Part-1, press: lab:Press-1)
        timeout 5 s { Flatten(part: lab:Part-2, press: lab:Press-1) }
    }
    expect failure "Flatten was not done after 5 s"
}

test a_circle_fails {
    scene  "hall.ttl"
    do     CleanBoth(one: lab:Press-1, other: lab:Press-2, part: lab:Part-1)
    expect failure "CIRCLE"
}

task bend {
    scene "hall.ttl"
    do par all {
        Flatten(part: lab:Part-1, press: lab:Press-1)
        Bend(part: lab:Part-1, press: lab:Press-1)
    }
}

task serve_first { scene "hall.ttl" do Serve(robot: lab:Robot-1, part: lab:Part-1, press: lab:Press-1) }
task serve_second { scene "hall.ttl" do Serve(robot: lab:Robot-2, part: lab:Part-2, press: lab:Press-1) }
"""
SCENE = """\
@prefix lab:    <http://example.org/lab#> .
@prefix hall:   <https://w3id.org/skillc/library/hall#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix skillc: <https://w3id.org/skillc/core#> .

lab:Hall a skiros:Scene ; skiros:contain lab:Press-1, lab:Press-2 .
lab:Press-1 a hall:Press ; hall:next lab:Press-2 .
lab:Press-2 a hall:Press ; hall:next lab:Press-1 .
lab:Part-1 a hall:Blank .
lab:Part-2 a hall:Blank .
lab:Part-3 a hall:Blank .
lab:Robot-1 a skillc:MobileRobot ; skiros:at lab:Press-1 ; skillc:deviceState "Idle" .
lab:Robot-2 a skillc:MobileRobot ; skiros:at lab:Press-1 ; skillc:deviceState "Idle" .
"""
CIRCLE = (
    "not clean: a circle of waits: Flatten waits for lab:Press-1, which Clean uses; "
    "in it, Flatten waits for lab:Press-2, which Clean uses; and Flatten is in Clean"
)


@pytest.fixture
def hall(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "hall.ttl").write_text(SCENE, "utf-8")
    (tmp_path / "hall.skill").write_text(LIBRARY.replace("CIRCLE", CIRCLE), "utf-8")
    (tmp_path / "skillc.toml").write_text('name = "hall"\nedition = 2\n[tool.run]\nbackend = "symbolic"\n', "utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_in_one_task_they_wait_and_a_circle_fails_and_names_all(hall: Path) -> None:
    checked = CliRunner().invoke(skillc, ["check", "."])
    assert "no problems" in checked.output, checked.output
    tested = CliRunner().invoke(skillc, ["test", "."])
    assert "4 tests, all passed" in tested.output, tested.output
    for name in ("both_are_flat_one_after_the_other", "three_parts_take_the_time_of_two"):
        assert re.search(rf"{name} +20.0 s", tested.output), tested.output


@pytest.mark.slow
def test_what_has_to_hold_is_looked_at_once_it_need_not_wait_any_more(hall: Path) -> None:
    done = CliRunner().invoke(skillc, ["run", "bend", "--tick-timeout", "0"])
    assert done.exit_code == 0, done.output
    assert "bend: Bend waits for lab:Press-1, which Flatten uses" in done.output
    assert re.search(r"time +13.0 s", done.output)


class Operations:
    """The tasks of the hall as operations of one cell."""

    def __init__(self, folder: Path) -> None:
        library = libraries.compile_library(find_library(folder)).value
        self.library = act_as_declared(library)
        self.cell = SymbolicCell(WorldModel(load_scene(folder / "hall.ttl", self.library.vocabulary)))
        self.loop = CellLoop(self.cell, self.library, LatePlanner(self.library))
        self.first, self.second = self.submit("serve_first"), self.submit("serve_second")

    def submit(self, task: str) -> Watched:
        body = self.library.tasks[task].body
        assert body is not None
        return submit(self.loop, Assignment(task, self.cell.world.snapshot(), ExecuteBody(body)))

    def tick_until(self, seconds: float) -> None:
        while self.cell.now < seconds and self.loop.runs:
            self.loop.tick()

    @property
    def ends(self) -> list[str | None]:
        return [self.first.run.end, self.second.run.end]


def test_an_operation_waits_for_the_press_of_another_one_and_not_for_its_end(hall: Path) -> None:
    cell = Operations(hall)
    cell.tick_until(9.0)
    assert cell.first.run.reason == ""
    assert cell.second.run.state == "running"
    assert cell.second.run.reason == f"Flatten waits for lab:Press-1, which Flatten of {cell.first.run.id} uses"
    cell.tick_until(12.0)
    assert (cell.second.run.reason, cell.first.run.end) == ("", None)
    cell.tick_until(60.0)
    assert cell.ends == ["succeeded", "succeeded"]
    assert 24.9 < cell.cell.now < 25.2, "10 s for each part, and 5 s after the second one"


def test_an_operation_that_waits_can_be_stopped_and_paused(hall: Path) -> None:
    cell = Operations(hall)
    cell.tick_until(3.0)
    cell.loop.request(cell.second.run, PauseRun("look"))
    cell.tick_until(12.0)
    assert cell.second.run.state == "paused"
    cell.loop.request(cell.second.run, Resume())
    cell.tick_until(13.0)
    assert (cell.second.run.state, cell.second.run.reason) == ("running", "")
    third = cell.submit("serve_first")
    cell.tick_until(16.0)
    assert third.run.reason == f"Flatten waits for lab:Press-1, which Flatten of {cell.second.run.id} uses"
    cell.loop.request(third.run, Stop("enough"))
    cell.tick_until(60.0)
    assert third.run.end == "stopped" and cell.ends == ["succeeded", "succeeded"]
