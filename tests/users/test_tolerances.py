"""`post sensed .. tolerance`: what is sensed may differ from what is computed by so much, and has to be sensed."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc

SCENE = """\
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix own: <https://w3id.org/skillc/library/own#> .
@prefix lab: <http://example.org/lab#> .
lab:Robot-1 a skillc:MobileRobot ; own:charge 36000.0 .
"""
LIBRARY = """\
use skillc
prefix lab: <http://example.org/lab#>
property charge(MobileRobot): Energy  range 0 Wh .. 100 Wh
skill Spend { in robot: MobileRobot  in much: Energy  post sensed robot.charge -= much  noplan }
impl own of Spend { run python "skillc.primitives:StandIn" }
skill Share { in robot: MobileRobot  in much: Energy  post sensed robot.charge -= 2 Wh tolerance 5 %  noplan }
impl own of Share { do Spend(robot, much) }
skill Amount { in robot: MobileRobot  in much: Energy  post sensed robot.charge := 8 Wh tolerance 0.5 Wh  noplan }
impl own of Amount { do Spend(robot, much) }
skill Nothing { in robot: MobileRobot  post sensed robot.charge -= 0 Wh tolerance 5 %  noplan }
impl own of Nothing { do seq { wait 1 s } }
"""
ROBOT = "robot: lab:Robot-1"
CASES = {
    f"do Share({ROBOT}, much: 2.3 Wh)  expect lab:Robot-1.charge == 7.7 Wh": "",
    f"do Share({ROBOT}, much: 2.5 Wh)": "5 %` is not so in the end: lab:Robot-1.charge is 27000 J; needed: 28800 J",
    f"do Share({ROBOT}, much: 1.5 Wh)": "lab:Robot-1.charge is 30600 J; needed: 28800 J",
    f"do Amount({ROBOT}, much: 2.5 Wh)": "",
    f"do Amount({ROBOT}, much: 3 Wh)": "lab:Robot-1.charge is 25200 J; needed: 28800 J",
    f"do Nothing({ROBOT})": "must be sensed, and nothing has sensed it",
    f"start lab:Robot-1.charge == 1 Wh  do Spend({ROBOT}, much: 2 Wh)": "stays in its range",
}


def test_what_is_sensed_may_differ_by_the_tolerance(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    tests = "".join(f'test t{at} {{ scene "lab.ttl"  {body} }}\n' for at, body in enumerate(CASES))
    Path("own.skill").write_text(LIBRARY + tests, "utf-8")
    Path("lab.ttl").write_text(SCENE, "utf-8")
    Path("skillc.toml").write_text('name = "own"\nedition = 2\n', "utf-8")
    done = CliRunner().invoke(skillc, ["test", "--json", "."], catch_exceptions=False)
    found = [" ".join(each["message"] for each in told["problems"]) for told in json.loads(done.stdout)["tests"]]
    assert len(found) == len(CASES)
    for wanted, said in zip(CASES.values(), found, strict=True):
        assert wanted in said and bool(wanted) == bool(said), found
