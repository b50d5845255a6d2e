"""`x.at` of a functional relation and values of enumerations, in conditions, arguments and goals."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc
from skillc_dsl.formatting.formatter import format_source
from skillc_dsl.source import Source

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


ENUMERATIONS = """\
enum     Grade { Good, Rework, Scrap }
enum     Mood { Good, Bad }
property grade(Thing1): Grade
property mood(Place): Mood
relation takes(Place, Grade)

## Grade `thing`.
skill Sort {
    in   thing: Thing1
    opt  as:    Grade = Good
    pre  not thing.grade == as
    pre  not Bad == thing.on.mood
    post thing.grade == as
}

impl own of Sort { run python "skillc.primitives:StandIn" }
"""


@pytest.mark.parametrize(
    "lines",
    [
        "do Sort(thing: lab:Cup)  expect lab:Cup.grade == Good  expect lab:Cup.grade != Scrap",
        "start lab:Cup.grade == Scrap  do Sort(thing: lab:Cup, as: Rework)  expect Rework == lab:Cup.grade",
        'start lab:Table.mood == Bad  do Sort(thing: lab:Cup)  expect failure "Bad"',
        "start lab:Table takes Good  do wait 1 s  expect lab:Table takes Good and not lab:Table takes Scrap",
        "do wait 1 s  expect forall g: Grade (g == Good or g == Rework or g == Scrap)",
        "do wait 1 s  expect exists g: Grade (g == Scrap) and not lab:Cup has grade",
        "goal lab:Cup.grade == Scrap or lab:Spoon.grade == Good  expect lab:Spoon.grade == Good",
    ],
)
def test_a_value_is_that_of_the_enumeration_expected(folder: Path, lines: str) -> None:
    done = run(folder, f'{ENUMERATIONS}test it {{ scene "lab.ttl"  {lines} }}\n', "test")
    assert done.exit_code == 0, done.output


@pytest.mark.parametrize(
    ("text", "name", "said"),
    [
        (
            "skill A { in a: Thing1  pre a.grade == Goood  noplan }",
            "unknown-value",
            "`Goood` is not a value of `Grade`",
        ),
        ("skill A { in a: Thing1  pre a.grade == Bad  noplan }", "unknown-value", "`Bad` is not a value of `Grade`"),
        ("skill A { in a: Thing1  opt b: Mood = Scrap  pre given b  noplan }", "unknown-value", "of `Mood`"),
        ("skill A { in a: Thing1  in b: Place  pre a.grade == b.mood  noplan }", "relation-range", "Mood"),
        ('skill A { in a: Thing1  pre a.grade == "Good"  noplan }', "wrong-operands", "a Grade and a Text"),
        ("skill A { in a: Thing1  pre a.grade < Good  noplan }", "wrong-operands", "`<` compares numbers"),
        ("enum Twice { One, Other, One }", "duplicate-declaration", "`One` is twice in `Twice`"),
        ("enum Grade { One }", "duplicate-declaration", "`Grade` is declared twice"),
        ("skill A { in a: Thing1  pre a.grade == Good and a.grade == Scrap  noplan }", "contradicting-conditions", ""),
    ],
)
def test_a_wrong_value_is_told_where_it_is(folder: Path, text: str, name: str, said: str) -> None:
    found = json.loads(run(folder, f"{ENUMERATIONS}{text}\n", "check", "--json").stdout)
    told = [each for each in found if each["name"] not in ("unused-prefix", "unused-parameter")]
    assert [(each["name"], said in each["message"]) for each in told] == [(name, True)], told


def test_a_scene_adds_no_value(folder: Path) -> None:
    (folder / "lab.ttl").write_text(f"{SCENE}lab:Better a own:Grade .\n", "utf-8")
    done = run(folder, f'{ENUMERATIONS}test it {{ scene "lab.ttl"  do wait 1 s }}\n', "test")
    assert done.exit_code == 1 and "lab:Better is no value of own:Grade" in done.output, done.output


def test_it_is_formatted_on_one_line_or_one_a_value() -> None:
    long = [f"value{number}" for number in range(16)]
    lines = ",\n    ".join(long)
    text = f"enum     One {{ a, b }}\nproperty two(One): One\nenum     Three {{\n    {lines}\n}}\n"
    assert format_source(Source("own.skill", text)).value == text
    short = f"enum One{{a,b}}\nproperty two(One): One\nenum Three{{{','.join(long)}}}\n"
    assert format_source(Source("own.skill", short)).value == text


def test_its_word_is_a_name_elsewhere() -> None:
    text = "class enum < Thing\nskill A {\n    in  enum: enum\n    pre enum is enum\n}\n"
    assert not format_source(Source("own.skill", text, edition=2)).diagnostics
