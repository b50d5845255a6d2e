"""Numbers of rounds that are computed, and lists: what runs, what is proved of it, and what is told of wrong ones."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc

LIBRARY = """\
prefix lab: <http://example.org/lab#>
class Lamp1
property lit(Lamp1): Bool

## Light `lamp`.
skill Light {
    in   lamp: Lamp1
    post lamp.lit == true
}

impl own of Light { run python "skillc.primitives:StandIn" }

## Wait `often` times a second.
skill Stay {
    opt often: Int = 2
    noplan
}

impl own of Stay { do repeat often { wait 1 s } }
"""
SCENE = """\
@prefix own: <https://w3id.org/skillc/library/own#> .
@prefix lab: <http://example.org/lab#> .
lab:Lamp a own:Lamp1 .
lab:Other a own:Lamp1 .
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
        "do timeout 2.5 s { Stay() }",
        "do timeout 3.5 s { Stay(often: 1 + 2) }",
        'do timeout 2.5 s { Stay(often: 3) }  expect failure "2.5 s"',
        'do Stay(often: 0)  expect failure "`repeat` needs a whole number of rounds from 1 to a million, not 0"',
        "do for lamp in [lab:Lamp, lab:Other] { Light(lamp) }  expect forall l: Lamp1 (l.lit == true)",
        "do for often in [1, 1 + 1] { timeout 2.5 s { Stay(often) } }",
        'do for often in [1, 3] { timeout 2.5 s { Stay(often) } }  expect failure "2.5 s"',
        'do timeout 3.5 s { retry 2 + 1 { seq { wait 1 s  fail "no" } } }  expect failure "no"',
        'do timeout 2.5 s { retry 2 + 1 { seq { wait 1 s  fail "no" } } }  expect failure "2.5 s"',
    ],
)
def test_it_runs_as_often_as_computed(folder: Path, lines: str) -> None:
    done = run(folder, f'test it {{ scene "lab.ttl"  {lines} }}\n', "test")
    assert done.exit_code == 0, done.output


@pytest.mark.parametrize(
    ("count", "body", "found"),
    [
        ("Int = 2  range 1 .. 5", "repeat n { Light(lamp) }", []),
        ("Int = 2  range 1 .. 50", "repeat n { Light(lamp) }", []),
        ("Int = 2", "repeat n { Light(lamp) }", []),
        ("Int = 2  range 1 .. 5", "retry n { Light(lamp) }", []),
        ("Int = 2  range 0 .. 5", "try { repeat n { Light(lamp) } }", ["post-not-established"]),
        ("Int = 2", "seq { retry n { check(lamp.lit == false) } Light(lamp) }", []),
        ("Int = 2  range 1 .. 3", "repeat n { try { Light(lamp) } }", ["post-not-established"]),
        ("Int = 2", "seq { for m in [n, 3] { Light(lamp) } }", []),
        ("Int = 2", "for m in [n, 3, 4] { try { Light(lamp) } }", ["post-not-established"]),
        ("Int = 2", "for m in [lamp, n] { Light(lamp) }", ["wrong-type"]),
        ("[Int] = [1, 2]", "for m in n { Light(lamp) }", ["post-not-established"]),
        ("Int = 0  range -3 .. 0", "repeat n { Light(lamp) }", ["bad-count"]),
        ("Number = 2", "repeat n { Light(lamp) }", ["wrong-type"]),
        ("Time = 2 s", "retry n { Light(lamp) }", ["wrong-type"]),
        ("Int = 2", "retry m { Light(lamp) }", ["unknown-parameter"]),
        ("Int = 2", "repeat 0 { Light(lamp) }", ["bad-count"]),
        ("Int", "repeat n { Light(lamp) }", ["unset-optional"]),
    ],
)
def test_its_range_is_proved(folder: Path, count: str, body: str, found: list[str]) -> None:
    text = f"skill Often {{ in lamp: Lamp1  opt n: {count}  post lamp.lit == true  noplan }}\n"
    text += f"impl own of Often {{ do {body} }}\n"
    told = json.loads(run(folder, text, "check", "--json").stdout)
    names = {each["name"] for each in told} - {"unused-prefix", "always-true"}
    assert sorted(names) == found, told
