"""`fail "REASON"`: whoever asks why is told the reason, with values and units; mistakes in it are reported there."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from skillc.cli.main import skillc
from skillc_dsl.formatting.formatter import format_source
from skillc_dsl.source import Source

LIBRARY = """\
use rparts, skillc
prefix lab: <http://example.org/lab#>

## Stay.
skill Stay {
    in  arm:   ArmDevice
    opt force: Force = 5 N
    opt fail:  Text
    noplan
}

impl put of Stay {
    let twice = 2 * force
    do seq {
        wait 1 s
        REASON
    }
}

test stays {
    scene  "lab.ttl"
    do     Stay(arm: lab:Arm-1)
    expect failure "EXPECTED"
}
"""
SCENE = """\
@prefix rparts: <http://www.inf.ufrgs.br/phi-group/ontologies/RParts.owl#> .
@prefix lab: <http://example.org/lab#> .
lab:Arm-1 a rparts:ArmDevice .
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "lab.ttl").write_text(SCENE, "utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(folder: Path, reason: str, *command: str, expected: str = "", more: str = "") -> Result:
    text = LIBRARY.replace("REASON", reason).replace("EXPECTED", expected)
    (folder / "own.skill").write_text(text + more, "utf-8")
    return CliRunner().invoke(skillc, [*command, "."], catch_exceptions=False)


@pytest.mark.parametrize(
    ("reason", "said"),
    [
        ("nobody is here", "nobody is here"),
        ("{arm} pushes with {force}, not {twice}", "lab:Arm-1 pushes with 5 N, not 10 N"),
        ("{{force}} is {force}", "{force} is 5 N"),
    ],
)
def test_the_reason_is_that_of_the_author(folder: Path, reason: str, said: str) -> None:
    done = run(folder, f'fail "{reason}"', "test", expected=said)
    assert done.exit_code == 0, done.output


@pytest.mark.parametrize(
    ("reason", "problem", "column", "help_"),
    [
        ("with {forse}", "unknown-parameter", 21, "did you mean `force`?"),
        ("with {fail}", "unset-optional", 21, "read it only under `given fail`"),
        ("with {arm.pose}", "syntax", 20, "write a name in braces, such as `{force}`, or `{{` for a brace"),
        ("with {", "syntax", 20, "or `{{` for a brace"),
        ("with }", "syntax", 20, "or `}}` for a brace"),
    ],
)
def test_what_is_wrong_is_reported_in_the_text(
    folder: Path, reason: str, problem: str, column: int, help_: str
) -> None:
    done = run(folder, f'fail "{reason}"', "check", "--json")
    found = [each for each in json.loads(done.stdout) if each["severity"] == "error"]
    assert [(each["name"], each["line"], each["column"]) for each in found] == [(problem, 16, column)], found
    assert help_ in found[0]["help"]


def test_what_follows_is_never_reached(folder: Path) -> None:
    done = run(folder, 'fail "no"\n        wait 1 s', "check")
    assert "unreachable-node" in done.stdout


def test_it_is_a_name_elsewhere() -> None:
    text = 'impl put of Stay {\n    do seq { fail(fail: fail) -> fail fail "no" }\n}\n'
    assert not format_source(Source("own.skill", text)).diagnostics


def test_a_value_in_a_text_that_is_passed_as_it_is_warns(folder: Path) -> None:
    more = '\nskill Say { in text: Text noplan }\nimpl own of Say { run python "skillc.primitives:StandIn" }\n'
    done = run(folder, 'Say(text: "{{arm}} {force} {other}")', "check", "--json", more=more)
    found = {each["name"]: (each["line"], each["column"]) for each in json.loads(done.stdout)}
    assert found.get("unread-value") == (16, 28), found
