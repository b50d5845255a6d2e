"""`x.at` of a functional relation, in conditions, arguments and goals; what has no value is told."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc

LIBRARY = """\
prefix lab: <http://example.org/lab#>
class Thing1
class Place
relation on(Thing1, Place)     functional
relation beside(Thing1, Thing1)
property hot(Place): Bool
property heating(Place): Time

## Heat `place`.
skill Heat {
    in   place: Place
    post place.hot == true
}

impl own of Heat { run python "skillc.primitives:StandIn" }

## Put `thing` on `to`.
skill Put {
    in   thing: Thing1
    in   to:    Place
    pre  thing has on
    pre  thing.on != to
    duration thing.on.heating
    post thing.on == to
}

impl own of Put { run python "skillc.primitives:StandIn" }
"""
SCENE = """\
@prefix own: <https://w3id.org/skillc/library/own#> .
@prefix lab: <http://example.org/lab#> .
lab:Cup a own:Thing1 ; own:on lab:Table .
lab:Spoon a own:Thing1 .
lab:Table a own:Place ; own:heating 7.0 .
lab:Shelf a own:Place .
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "lab.ttl").write_text(SCENE, "utf-8")
    (tmp_path / "skillc.toml").write_text('name = "own"\nedition = 2\n', "utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(folder: Path, text: str, *command: str) -> Result:
    (folder / "own.skill").write_text(LIBRARY + text, "utf-8")
    return CliRunner().invoke(skillc, [*command, "."], catch_exceptions=False)


@pytest.mark.parametrize(
    "lines",
    [
        "do Heat(place: lab:Cup.on)  expect lab:Table.hot == true",
        'do Heat(place: lab:Spoon.on)  expect failure "lab:Spoon has no own:on"',
        "goal lab:Cup.on == lab:Shelf  expect lab:Cup on lab:Shelf  expect not lab:Cup on lab:Table",
        "goal lab:Cup.on == lab:Shelf and lab:Cup.on.hot == true  expect lab:Shelf.hot == true",
        "goal lab:Spoon.on == lab:Shelf  expect no plan",
        "goal lab:Cup.on == lab:Spoon.on  expect no plan",
    ],
)
def test_it_is_the_one_thing_of_the_relation(folder: Path, lines: str) -> None:
    done = run(folder, f'test it {{ scene "lab.ttl"  {lines} }}\n', "test")
    assert done.exit_code == 0, done.output


@pytest.mark.parametrize(
    ("condition", "name", "said"),
    [
        ("thing.beside == thing", "unknown-property", "may hold of several things"),
        ("place.on == place", "relation-domain", "on its left stands a Place"),
        ("thing.on == thing", "relation-range", "on its right stands a Thing1"),
        ("place.on.hot == true", "relation-domain", "on its left stands a Place"),
        ("thing.on.beside == thing", "unknown-property", "may hold of several things"),
        ("thing.on < place", "wrong-operands", "`<` compares numbers"),
    ],
)
def test_mistakes_are_told_where_they_are(folder: Path, condition: str, name: str, said: str) -> None:
    text = f"skill Ask {{ in thing: Thing1  in place: Place  pre {condition}  noplan }}\n"
    found = json.loads(run(folder, text, "check", "--json").stdout)
    told = [each for each in found if each["severity"] == "error"]
    assert [(each["name"], said in each["message"]) for each in told] == [(name, True)], told
