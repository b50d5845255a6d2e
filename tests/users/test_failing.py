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
@prefix skillc: <https://w3id.org/skillc/core#> .
lab:Arm-1 a rparts:ArmDevice ; skillc:deviceState "Idle" .
"""


SAY = """
skill Say { in text: Message noplan }
impl failing of Say { do seq { fail "{text}!" } }
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    (tmp_path / "lab.ttl").write_text(SCENE, "utf-8")
    (tmp_path / "skillc.toml").write_text('name = "own"\nedition = 2\n', "utf-8")
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
        ("{arm} is {arm.deviceState}", "lab:Arm-1 is Idle"),
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
        ("with {arm.deviceStat}", "unknown-property", 25, "did you mean `deviceState`?"),
        ("with {force:.1f}", "syntax", 20, "write `{force}`: values are written with their units"),
        ("with {force * 2}", "syntax", 20, "name what is computed with `let`"),
        ("with {", "syntax", 20, "or `{{` for a brace"),
        ("with }", "syntax", 20, "or `}}` for a brace"),
    ],
)
@pytest.mark.parametrize("said", ['fail "{}"', 'Say(text: "{}")'])
def test_what_is_wrong_is_reported_in_the_text(
    folder: Path, said: str, reason: str, problem: str, column: int, help_: str
) -> None:
    done = run(folder, said.replace("{}", reason), "check", "--json", more=SAY)
    found = [each for each in json.loads(done.stdout) if each["severity"] == "error"]
    there = column + said.index("{}") - len('fail "')
    assert [(each["name"], each["line"], each["column"]) for each in found] == [(problem, 16, there)], found
    assert help_ in found[0]["help"]


def test_a_message_has_the_values_of_whoever_passes_it(folder: Path) -> None:
    done = run(folder, 'Say(text: "{arm} takes {{{twice}}}")', "test", expected="lab:Arm-1 takes {10 N}!", more=SAY)
    assert done.exit_code == 0, done.output


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


HANDLED = """
impl other of Stay {
    prefer 2
    do seq {
        check(force > 9 N)
        wait 1 s
    } on failure as why {
        HANDLER
    }
}
"""


@pytest.mark.parametrize(
    ("handler", "said"),
    [
        ('fail "no: {why}"', "no: `force > 9 N` does not hold"),
        ('fail "{why.kind} of {why.skill}: {why.message}"', "body of Stay: `force > 9 N` does not hold"),
        ('fail "see {why.source}"', "see own.skill:29"),
        ('if why.kind == "body" { fail "of the body" }', "of the body"),
        ('if why.kind == "timeout" { wait 1 s } else { fail "not late" }', "not late"),
    ],
)
def test_what_is_done_on_failure_knows_why(folder: Path, handler: str, said: str) -> None:
    more = HANDLED.replace("HANDLER", handler)
    done = run(folder, "wait 1 s", "test", expected=said, more=more)
    assert done.exit_code == 0, done.output


def test_what_recovers_succeeds(folder: Path) -> None:
    (done,) = json.loads(run(folder, "wait 1 s", "test", "--json", more=HANDLED.replace("HANDLER", "wait 2 s")).stdout)[
        "tests"
    ]
    assert ["a failure with" in each["message"] for each in done["problems"]] == [True], done


def test_what_follows_from_the_block_is_not_assumed_on_failure(folder: Path) -> None:
    text = """\
skill Clear { in arm: ArmDevice  post arm.deviceState == Idle  noplan }
impl own of Clear { run python "skillc.primitives:StandIn" }
skill Must { in arm: ArmDevice  pre arm.deviceState == Idle  noplan }
impl own of Must { run python "skillc.primitives:StandIn" }
skill Both { in arm: ArmDevice  post arm.deviceState == Idle  noplan }
impl one of Both { do seq { Clear(arm) } on failure { Must(arm) } }
impl two of Both { prefer 2  do seq { Clear(arm) Must(arm) } on failure { Clear(arm) } }
impl three of Both { prefer 4  do seq { Clear(arm) Must(arm) } on failure { wait 1 s } }
"""
    (folder / "both.skill").write_text(f"use rparts, skillc\n{text}", "utf-8")
    done = run(folder, "wait 1 s", "check", "--json")
    found = [(each["name"], each["line"]) for each in json.loads(done.stdout) if each["path"].endswith("both.skill")]
    assert found == [("child-precondition", 7), ("post-not-established", 9)], done.stdout


def test_a_part_that_a_failure_does_not_have_is_an_error(folder: Path) -> None:
    more = HANDLED.replace("HANDLER", 'if why.sort == "body" { wait 1 s }')
    found = json.loads(run(folder, "wait 1 s", "check", "--json", more=more).stdout)
    (problem,) = (each for each in found if each["name"] == "unknown-property")
    assert "has no `sort`" in problem["message"] and "`kind`, `message`, `skill`" in problem["help"]


def test_it_is_formatted_as_else_is() -> None:
    text = (
        "impl put of Stay {\n    do with Hold(arm) {\n        Go(arm)\n    } on failure as on {\n"
        "        Go(on: on, as: failure)\n    }\n}\n"
    )
    assert format_source(Source("own.skill", text)).value == text
    assert format_source(Source("own.skill", " ".join(text.split()))).value == text
    alone = text.replace("with Hold(arm) {\n        Go(arm)\n    }", "Go(arm)")
    assert format_source(Source("own.skill", " ".join(alone.split()))).value == alone


def test_its_words_are_names_in_older_editions(folder: Path) -> None:
    names = "impl put of Stay {\n    do on(as: failure)\n}\n"
    assert not format_source(Source("own.skill", names, edition=1)).diagnostics
    assert format_source(Source("own.skill", names, edition=2)).diagnostics


AT_THE_END = """\
use rparts
prefix lab: <http://example.org/lab#>
property lamp(ArmDevice): Bool
property door(ArmDevice): Bool
skill Light { in arm: ArmDevice  post arm.lamp == true  noplan }
impl own of Light { run python "skillc.primitives:StandIn" }
skill Shut { in arm: ArmDevice  pre arm.lamp == true  post arm.door == false  noplan }
impl own of Shut { run python "skillc.primitives:StandIn" }
"""


def run_text(folder: Path, text: str, *command: str) -> Result:
    (folder / "own.skill").write_text(AT_THE_END + text, "utf-8")
    return CliRunner().invoke(skillc, [*command], catch_exceptions=False)


@pytest.mark.parametrize(
    ("block", "last", "expected"),
    [
        ("wait 1 s", "Light(arm: lab:Arm-1)", "expect lab:Arm-1.lamp == true"),
        ('fail "no"', "Light(arm: lab:Arm-1)", 'expect failure "no"  expect lab:Arm-1.lamp == true'),
        ("wait 1 s", 'fail "no"', "expect not lab:Arm-1 has lamp"),
        ("timeout 1 s { seq { wait 2 s } finally { Light(arm: lab:Arm-1) } }", "wait 1 s", 'expect failure "1 s"'),
        (
            "try { timeout 1 s { seq { wait 2 s } finally { Light(arm: lab:Arm-1) } } }",
            "wait 1 s",
            "expect not lab:Arm-1 has lamp",
        ),
        (
            'seq { fail "no" } on failure { Light(arm: lab:Arm-1) }',
            "Shut(arm: lab:Arm-1)",
            "expect lab:Arm-1.door == false",
        ),
    ],
)
def test_what_is_done_at_the_end_does_not_change_the_result(folder: Path, block: str, last: str, expected: str) -> None:
    text = f'test both {{ scene "lab.ttl"  do seq {{ {block} }} finally {{ {last} }}  {expected} }}\n'
    done = run_text(folder, text, "test", ".")
    assert done.exit_code == 0, done.output


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        (
            'Shut(arm: lab:Arm-1) on failure as why { if why.kind == "pre" { Light(arm: lab:Arm-1) } }',
            "expect lab:Arm-1.lamp == true",
        ),
        (
            'retry 2 { fail "no" } on failure { fail "never" } finally { Light(arm: lab:Arm-1) }',
            'expect failure "never"  expect lab:Arm-1.lamp == true',
        ),
    ],
)
def test_a_body_of_one_step_has_an_end_as_well(folder: Path, body: str, expected: str) -> None:
    done = run_text(folder, f'test both {{ scene "lab.ttl"  do {body}  {expected} }}\n', "test", ".")
    assert done.exit_code == 0, done.output


@pytest.mark.parametrize(
    ("block", "last", "found"),
    [
        ("Light(arm)  Shut(arm)", "wait 1 s", []),
        ("Light(arm)  Shut(arm)", "Light(arm)  Shut(arm)", []),
        ("wait 1 s", "Light(arm)  Shut(arm)", ["post-not-established"]),
        ("Light(arm)  Shut(arm)", "Shut(arm)", ["child-precondition"]),
        ("Light(arm)  Shut(arm)", "", ["empty-block"]),
    ],
)
def test_the_end_is_proved_after_success_and_failure(folder: Path, block: str, last: str, found: list[str]) -> None:
    text = "skill Both { in arm: ArmDevice  post arm.lamp == true  post arm.door == false  noplan }\n"
    text += f"impl one of Both {{ do seq {{ {block} }} finally {{ {last} }} }}\n"
    done = run_text(folder, text, "check", "--json", ".")
    names = {each["name"] for each in json.loads(done.stdout)}
    assert sorted(names - {"unused-prefix"}) == found, done.stdout


def test_what_fails_at_the_end_is_told(folder: Path) -> None:
    text = 'task both { scene "lab.ttl"  do seq { wait 1 s } finally { fail "it is stuck" } }\n'
    done = run_text(folder, text, "run", "both", "--backend", "symbolic", "--out", "run")
    assert done.exit_code == 0, done.output
    why = CliRunner().invoke(skillc, ["why", "run"], catch_exceptions=False)
    assert "both: succeeded" in why.output and "at the end: it is stuck" in why.output, why.output
