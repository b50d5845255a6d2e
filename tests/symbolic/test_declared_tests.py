"""`skillc test`: what passes, what fails and why, selection, coverage, JUnit XML, JSON; words stay names elsewhere."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree import ElementTree

import pytest
from click.testing import CliRunner, Result

from docs.pages import ROOT, blocks
from skillc.cli.main import skillc
from skillc.services.check.checking import CheckRequest, check_paths
from symbolic.ward import write_ward

HEAD = 'use skiros, skillc\nimport "terms.skill"\nprefix lab: <http://example.org/lab#>\n'
CARRY = "Carry(cart: lab:Cart-1, tray: lab:Tray-1, to: lab:Kitchen)"
PASSING = f"""{HEAD}
## A tray is in one place.
test a_tray_moves {{
    scene  "ward.ttl"
    do     {CARRY}
    expect lab:Kitchen contain lab:Tray-1
    expect not lab:Ward-1 contain lab:Tray-1
}}

test from_elsewhere {{
    scene  "ward.ttl"
    start  lab:Cart-1 at lab:Ward-2 and not lab:Cart-1 at lab:Ward-1
    do     {CARRY}
    expect failure "no answer for"
}}

test all_is_planned {{
    scene  "ward.ttl"
    goal   lab:Kitchen contain lab:Tray-1 and lab:Kitchen contain lab:Tray-2
    expect lab:Cart-1 at lab:Kitchen
}}

test broken_down {{
    scene  "ward.ttl"
    start  lab:Cart-1.deviceState == Fault
    goal   lab:Kitchen contain lab:Tray-1
    expect no plan
}}
"""


TAKING = """use skiros
prefix lab: <http://example.org/lab#>
import "terms.skill"

skill Fetch {
    in   place: Location
    in   from:  Location
    pre  not place == from
    post some tray: Tray (place contain tray and not from contain tray where from contain tray)
    duration 5 s
}

skill FetchTwo {
    in   place: Location
    in   from:  Location
    pre  not place == from
    post some one:   Tray (place contain one and not from contain one where from contain one)
    post some other: Tray (place contain other and not from contain other where from contain other and not other == one)
}
impl at_once of FetchTwo { do par all { Fetch(place, from, tray: one)  Fetch(place, from, tray: other) } }

test each_takes_another_one {
    scene  "ward.ttl"
    start  lab:Ward-1 contain lab:Tray-2 and not lab:Ward-2 contain lab:Tray-2
    do     par all { Fetch(place: lab:Kitchen, from: lab:Ward-1)  Fetch(place: lab:Kitchen, from: lab:Ward-1) }
    expect lab:Kitchen contain lab:Tray-1 and lab:Kitchen contain lab:Tray-2
}

test both_are_taken {
    scene  "ward.ttl"
    start  lab:Ward-1 contain lab:Tray-2 and not lab:Ward-2 contain lab:Tray-2
    do     FetchTwo(place: lab:Kitchen, from: lab:Ward-1)
    expect lab:Kitchen contain lab:Tray-1 and lab:Kitchen contain lab:Tray-2
}

test nothing_is_left {
    scene  "ward.ttl"
    do     FetchTwo(place: lab:Kitchen, from: lab:Ward-1)
    expect failure "no answer for"
}
"""


@pytest.fixture
def ward(tmp_path: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = write_ward(tmp_path)
    monkeypatch.chdir(folder)
    return folder


def run(*arguments: str) -> Result:
    result = CliRunner().invoke(skillc, ["test", *arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result


def write(folder: Path, text: str, name: str = "tests.skill") -> None:
    (folder / name).write_text(text, encoding="utf-8")


def failures(folder: Path, body: str) -> list[dict[str, object]]:
    """Return the problems of a test with this body."""
    write(folder, f'{HEAD}\ntest one {{\n    scene "ward.ttl"\n{body}\n}}\n')
    result = run("--json")
    found = json.loads(result.stdout)
    assert result.exit_code == (1 if found["failed"] else 0)
    return list(found["tests"][0]["problems"])


def test_what_is_as_expected_passes(ward: Path) -> None:
    write(ward, PASSING)
    result = run()
    assert result.exit_code == 0, result.output
    assert [line.split()[:2] for line in result.stdout.splitlines()] == [
        ["passed", "a_tray_moves"],
        ["passed", "from_elsewhere"],
        ["passed", "all_is_planned"],
        ["passed", "broken_down"],
    ]
    assert "4 tests, all passed" in result.stderr


def test_what_breaks_always_is_shown(ward: Path) -> None:
    """Of a body the call that broke it, and of a goal that no plan keeps it."""
    go = "Go(cart: lab:Cart-1, to: lab:Ward-2)"
    body = f"    always forall c: Cart (not c at lab:Ward-2)\n    do seq {{ {CARRY} {go} wait 1 s }}"
    (problem,) = failures(ward, body)
    assert "`one` failed: `always forall c: ward:Cart (not c at lab:Ward-2)` is broken: " in str(problem["message"])
    told = [each["message"] for each in problem["labels"]]  # type: ignore[attr-defined]
    assert told == [
        "1: Carry[by_itself] succeeded after 20 s",
        "2: Go[as_declared] succeeded after 10 s; this broke what is to hold always",
    ]
    planned = "    goal lab:Kitchen contain lab:Tray-1\n    always not lab:Cart-1 at lab:Kitchen\n    expect no plan"
    assert failures(ward, planned) == []


def test_a_failure_is_a_diagnostic_with_the_path_that_led_there(ward: Path) -> None:
    (problem,) = failures(ward, f"    do seq {{ wait 1 s {CARRY} }}\n    expect lab:Ward-2 contain lab:Tray-1")
    assert problem["name"] == "test-failed" and problem["line"] == 8
    assert "`lab:Ward-2 contain lab:Tray-1` does not hold at the end: lab:Ward-2 contain lab:Tray-2" in str(
        problem["message"]
    )
    (label,) = problem["labels"]  # type: ignore[misc]
    assert label["message"] == "1: Carry[by_itself] succeeded after 20 s" and label["line"] == 7


@pytest.mark.parametrize(
    ("body", "words"),
    [
        (f"    do {CARRY.replace('Tray-1', 'Tray-2')}", "`one` failed: no answer for `cart at from`"),
        ("    goal lab:Kitchen contain lab:Ward-1", "`one` did not start: "),
        (f'    do {CARRY}\n    expect failure "broken"', "it succeeded, but a failure with `broken` was expected"),
        (
            f'    do {CARRY.replace("Tray-1", "Tray-2")}\n    expect failure "broken"',
            "it failed, but for another reason: no answer",
        ),
        ("    goal lab:Kitchen contain lab:Tray-1\n    expect no plan", "there is a plan"),
        ("    do wait until (lab:Kitchen contain lab:Tray-1)", "`one` failed: the task exceeded its deadline"),
        (
            "    start lab:Tray-1.isWarm == true\n    do wait 1 s\n    expect lab:Tray-1.isWarm == false",
            "does not hold at the end",
        ),
    ],
)
def test_each_way_to_fail_says_what_is_otherwise(ward: Path, body: str, words: str) -> None:
    assert [each["message"] for each in failures(ward, body) if words in str(each["message"])], failures(ward, body)


def test_the_calls_inside_what_failed_are_part_of_the_path(ward: Path) -> None:
    write(
        ward,
        f"""{HEAD}
skill Serve {{ in tray: Tray noplan }}
impl later of Serve {{
    do seq {{
        wait 1 s
        Taste(tray)
    }}
}}
skill Taste {{ in tray: Tray noplan }}
impl once of Taste {{ do check(tray.isWarm == true) }}
test one {{
    scene "ward.ttl"
    do    Serve(tray: lab:Tray-1)
}}
""",
    )
    (problem,) = json.loads(run("--json", "one").stdout)["tests"][0]["problems"]
    assert "`one` failed: `tray.isWarm == true` does not hold" in problem["message"]
    assert [each["line"] for each in problem["labels"]] == [16, 9]
    assert problem["labels"][1]["message"].startswith("inside: Taste[once] failed after 0 s: ")


def test_tests_are_selected_by_file_and_name(ward: Path) -> None:
    write(ward, PASSING)
    write(ward, f'{HEAD}test other {{ scene "ward.ttl" do wait 1 s }}\n', "other.skill")
    assert run("other.skill").stdout.split()[1] == "other"
    assert run("*tray*").stdout.split()[1] == "a_tray_moves"
    assert len(run("other", "broken_down").stdout.splitlines()) == 2
    missing = run("a_tray_move")
    assert missing.exit_code == 2 and "there is no test `a_tray_move`" in missing.stderr
    assert "did you mean `a_tray_moves`?" in missing.stderr or "a_tray_moves" in missing.stderr
    (ward / "tests.skill").unlink()
    (ward / "other.skill").unlink()
    assert run().exit_code == 2 and "there are no tests" in run().stderr
    write(ward, "test broken {")
    assert run().exit_code == 1


def test_coverage_names_the_lines_that_nothing_ran(ward: Path) -> None:
    write(
        ward,
        f"""{HEAD}
skill Visit {{
    in   cart: Cart
    in   tray: Tray
    noplan
}}

impl gently of Visit {{
    do seq {{
        if tray.isWarm == true {{
            wait 1 s
        }} else {{
            wait 2 s
        }}
        check(tray.isWarm == true)
    }}
}}

test warm {{
    scene "ward.ttl"
    start lab:Tray-1.isWarm == true
    do    Visit(cart: lab:Cart-1, tray: lab:Tray-1)
}}
""",
    )
    result = run("--coverage")
    assert result.exit_code == 0
    assert "ward: skills 1 of 5, implementations 1 of 5, nodes 4 of 5, conditions 2 of" in result.stdout
    assert "tests.skill  not run: 16" in result.stdout and "tests.skill  one way only: 13, 18" in result.stdout
    report = json.loads(run("--json").stdout)["coverage"][0]
    assert report["counts"]["nodes"] == {"covered": 4, "total": 5}
    assert report["uncovered"]["tests.skill"] == [16] and report["half"]["tests.skill"] == [13, 18]


def test_junit_has_a_case_for_each(ward: Path) -> None:
    write(ward, PASSING + f'\ntest wrong {{ scene "ward.ttl" do {CARRY} expect failure "a & b <c>" }}\n')
    assert run("--junit", "out.xml").exit_code == 1
    root = ElementTree.parse("out.xml").getroot()
    assert (root.get("tests"), root.get("failures")) == ("5", "1")
    (failed,) = [each for each in root.iter("testcase") if each.find("failure") is not None]
    failure = failed.find("failure")
    assert failed.get("name") == "wrong" and failure is not None
    assert "a & b <c>" in str(failure.get("message")) and "Carry[by_itself] succeeded" in str(failure.text)


def test_new_words_are_names_elsewhere(ward: Path) -> None:
    write(
        ward,
        """use skiros
relation no(Product, Product)
relation failure(Product, Product)
relation expecting(Product, Product)
property test(Product): Number
property start(Product): Number
skill Look {
    in  test:    Product
    in  start:   Product
    in  expect:  Product
    opt failure: Number = 3
    opt no:      Number = 3
    opt plan:    Number = 3
    pre test no start and expect failure test
    pre start.test > failure and expect.start == no + plan
    post plan_: test no expect
}
skill test { in plan: Product noplan }
impl no of test { run python "skillc.primitives:StandIn" }
impl plan of Look { do seq { test(plan: start) apply plan_ } }
""",
        "words.skill",
    )
    problems = check_paths(CheckRequest((Path("words.skill"),))).diagnostics
    assert [each.name for each in problems if each.severity == "error"] == []


@pytest.mark.parametrize("word", ["start", "expect", "plan"])
def test_a_relation_that_is_called_like_a_member_needs_its_prefix(ward: Path, word: str) -> None:
    skill = f"skill Look {{ in a: Product in b: Product pre a {word} b noplan }}"
    text = f"use skiros\nrelation {word}(Product, Product)\n{skill}\n"
    write(ward, text, "words.skill")
    (ward / "skillc.toml").write_text('name = "ward"\nedition = 2\n', "utf-8")
    problems = check_paths(CheckRequest((Path("words.skill"),))).diagnostics
    assert "reserved-word" in [each.name for each in problems]


def test_the_example_of_the_reference_passes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (example,) = [each.text for each in blocks(ROOT / "docs/language.md") if not each.words and "\ntest " in each.text]
    write(tmp_path, example)
    result = run()
    assert result.exit_code == 0 and result.stdout.count("passed") == 3, result.output


def test_what_is_on_some_is_taken_of_what_others_have_not_locked(ward: Path) -> None:
    (ward / "skillc.toml").write_text('name = "ward"\nedition = 2\n', encoding="utf-8")
    (ward / "taking.skill").write_text(TAKING, encoding="utf-8")
    result = run("taking.skill")
    assert result.exit_code == 0, result.output
