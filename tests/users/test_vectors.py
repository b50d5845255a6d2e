"""Vectors and directions from the vocabulary to a run: what a scene states, what is refused, what is kept."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc

SKILLS = """\
prefix lab: <http://example.org/lab#>

class Fan < Thing
property wind(Fan): Vector of Speed
property facing(Fan): Direction
function far(way: Vector of Length) -> Length = python "vectors_of_fans:far"
function skew(fan: Fan) -> Direction = python "vectors_of_fans:skew"

skill Blow {
    in   fan:   Fan
    in   to:    Fan
    in   along: Direction
    in   way:   Vector of Length

    pre  fan.facing == along
    post turned: to.facing == along
    post blown:  to.wind == fan.wind
    noplan
}

impl plain of Blow {
    run python "skillc.primitives:StandIn"
}

task fine {
    scene "scene.ttl"
    do seq {
        check(far(2 s * lab:F1.wind) > 1 m)
        Blow(fan: lab:F1, to: lab:F2, along: -1 * -lab:F1.facing, way: 2 s * lab:F1.wind)
    }
}
"""
SKEW = """
task skewed {
    scene "scene.ttl"
    do    Blow(fan: lab:F1, to: lab:F2, along: skew(lab:F1), way: 2 s * lab:F1.wind)
}
"""
PYTHON = """\
import numpy as np

def far(state, way):
    return np.linalg.norm(way)

def skew(state, fan):
    return np.array([1.0, 1.0, 0.0])
"""
SCENE = """\
@prefix lab: <http://example.org/lab#> .
@prefix fans: <https://w3id.org/skillc/library/fans#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
lab:F1 a fans:Fan ; fans:wind "0 0 3.5" ; fans:facing "0 -0.6 +.8"^^skillc:Direction .
lab:F2 a fans:Fan ; fans:facing "0.7071 0 0.7071" .
"""


def call(*arguments: str) -> Result:
    result = CliRunner().invoke(skillc, arguments)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


@pytest.fixture
def fans(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "fans"
    folder.mkdir()
    (folder / "fans.skill").write_text(SKILLS)
    (folder / "scene.ttl").write_text(SCENE)
    (tmp_path / "vectors_of_fans.py").write_text(PYTHON)
    monkeypatch.syspath_prepend(str(tmp_path))
    monkeypatch.chdir(folder)
    return folder


@pytest.mark.sim
def test_a_scene_states_vectors_which_a_run_writes_and_a_store_keeps(fans: Path) -> None:
    assert call("check", ".", "--scene", "scene.ttl", "--format", "concise").stdout == ""
    for _ in range(2):  # the second time the world is what the store kept
        ran = call("run", ":fine", "--store", "kept")
        assert ran.exit_code == 0, ran.output
        assert "along: (0, -0.6, 0.8), way: (0, 0, 7) m" in " ".join(ran.output.split())
    told = json.loads(call("world", "--library", ".", "--store", "kept", "--json").stdout)
    assert told[1]["properties"] == {"fans:facing": [0, -0.6, 0.8], "fans:wind": [0, 0, 3.5]}


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("0 -0.6 +.8", "0 -0.6 8", 'is of length 8.02247 | write "0 -0.07479 0.9972"'),
        ("0 -0.6 +.8", "0 0 0", 'is of length 0 | write "0 0 1"'),
        ("0 -0.6 +.8", "0 0.6", '"0 0.6" is not three numbers | write three numbers'),
        ("0 0 3.5", "0 0 nan", "is not three numbers"),
        ("0 0 3.5", "0,0,3.5", "is not three numbers"),
        ('"0 0 3.5"', "3.5", "it takes three numbers in quotes"),
    ],
)
def test_what_is_no_vector_or_no_direction_is_reported(fans: Path, old: str, new: str, words: str) -> None:
    assert old in SCENE
    (fans / "scene.ttl").write_text(SCENE.replace(old, new))
    checked = call("check", ".", "--scene", "scene.ttl", "--json")
    (found,) = json.loads(checked.stdout)
    assert checked.exit_code == 1 and (found["name"], found["line"]) == ("wrong-data-type", 4)
    assert words in f"{found['message']} | {found['help']}"
    ran = call("run", ":fine")
    assert ran.exit_code == 1 and "wrong-data-type" in ran.output


def test_python_that_gives_no_direction_is_reported_before_the_run_and_refused_in_it(fans: Path) -> None:
    (fans / "fans.skill").write_text(SKILLS + SKEW)
    words = "skew gives (1, 1, 0), where its declaration says `Direction`"
    checked = call("check", ".", "--scene", "scene.ttl", "--format", "concise")
    assert "cannot-start" in checked.stdout and words in checked.stdout
    ran = call("run", ":skewed")
    assert ran.exit_code == 3 and words in " ".join(ran.output.split())


def test_an_edit_that_leaves_no_direction_is_refused(fans: Path) -> None:
    refused = call("scene", "edit", "scene.ttl", "--library", ".", 'lab:F2 fans:facing "0 1 1"')
    assert refused.exit_code == 1 and "of length 1.41421" in refused.stderr
    assert (fans / "scene.ttl").read_text() == SCENE
    assert call("scene", "edit", "scene.ttl", "--library", ".", 'lab:F2 fans:wind "1 0 -2"').exit_code == 0
    assert "fans:wind (1, 0, -2)" in call("world", "scene.ttl", "--library", ".", "--show", "lab:F2").stdout
