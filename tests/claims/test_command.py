"""`skillc run` says whether a success was sensed, with an exit code where that is wanted; so does `skillc why`."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli import main

LIBRARY = """
use skiros
prefix lab: <http://example.org/lab#>

skill Put {
    in    part: Product
    in    to:   Location
    infer from: Location

    pre   from contain part
    post  to contain part
    post  not from contain part
    duration 2 s
}

impl by_somebody of Put {
    run python "skillc.primitives:StandIn"
}

task put {
    scene "scene.ttl"
    goal  lab:Box contain lab:Part
}

task look_only {
    scene "scene.ttl"
    goal  lab:Tray contain lab:Part
}
"""
SCENE = """
@prefix lab:    <http://example.org/lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .

lab:Tray a skiros:Location ; skiros:contain lab:Part .
lab:Box a skiros:Location .
lab:Part a skiros:Product .
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "put.skill").write_text(LIBRARY, encoding="utf-8")
    (tmp_path / "scene.ttl").write_text(SCENE, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def skillc(*words: str) -> Result:
    return CliRunner().invoke(main.skillc, words, catch_exceptions=False)


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize(
    ("task", "strict", "code", "verified"),
    [("put", (), 0, False), ("put", ("--strict",), 3, False), ("look_only", ("--strict",), 0, True)],
)
def test_a_success_that_rests_on_an_assumption_is_strictly_none(
    task: str, strict: tuple[str, ...], code: int, verified: bool
) -> None:
    ran = skillc("run", f".:{task}", *strict, "--json")
    assert ran.exit_code == code, ran.output
    result = json.loads(ran.stdout)
    assert (result["status"], result["verified"]) == ("succeeded", verified)


@pytest.mark.usefixtures("folder")
def test_the_table_and_the_recording_say_what_was_not_sensed(folder: Path) -> None:
    shown = skillc("run", ".:put", "--out", "out")
    words = " ".join(shown.stdout.split())
    assert shown.exit_code == 0
    assert words.startswith(
        "put finished, not verified lab:Box contain lab:Part is only assumed: a device would have to"
    )
    assert "put: finished, not verified" in shown.stderr, "live as well"
    why = skillc("why", "out").stdout
    assert why.startswith("put: finished, not verified after")
    assert "lab:Box contain lab:Part  (assumed by Put)" in why
    assert json.loads(skillc("why", "out", "--json").stdout)["verified"] is False
    page = (folder / "out" / "report.html").read_text(encoding="utf-8")
    assert "finished, not verified" in page and "is only assumed" in page
