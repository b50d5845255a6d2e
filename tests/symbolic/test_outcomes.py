"""What comes of skills without bodies: drawn or stated, followed by the run, explained and repeated."""

from __future__ import annotations

import json
from pathlib import Path

import msgspec
import pytest
from click.testing import CliRunner, Result

from docs.pages import ROOT, blocks
from skillc.cli.main import skillc
from skillc.contract.plan import PlanPreview
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import find_library
from skillc_runtime.execution.tree.stand_ins import choose_outcome
from skillc_runtime.scene.load import load_scene, load_sheets
from skillc_runtime.scene.saving import format_scene
from skillc_runtime.world.state.changes import AddIndividual, AddRelation


@pytest.fixture
def sorting(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Write the files of the how-to; its tests are followed elsewhere."""
    for block in blocks(ROOT / "docs/how-to/look-then-sort.md"):
        if block.words in ("sorting.skill", "sorting.ttl", "skillc.toml", "tasks.skill"):
            (tmp_path / block.words).write_text(block.text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path


def call(*arguments: str, code: int = 0) -> Result:
    result = CliRunner().invoke(skillc, arguments)
    assert result.exit_code == code, result.output
    return result


def test_what_comes_is_drawn_by_how_likely_it_is(sorting: Path) -> None:
    outcomes = compile_valid(find_library(sorting)).skills["Look"].outcomes
    drawn = [choose_outcome(outcomes, ("good", "scrap"), str(seed)) for seed in range(1000)]
    assert 850 < drawn.count("good") < 950 and set(drawn) == {"good", "scrap"}
    assert drawn == [choose_outcome(outcomes, ("good", "scrap"), str(seed)) for seed in range(1000)]
    assert {choose_outcome(outcomes, ("scrap",), str(seed)) for seed in range(100)} == {"scrap"}
    assert choose_outcome((), (), "0") == ""


def test_a_policy_is_recorded_and_repeated(sorting: Path) -> None:
    call("run", "sort", "--out", "out", "--tick-timeout", "0")
    assert "the same but for wall times" in call("replay", "--check", "out").stdout
    assert "Look has ended with" in call("why", "out").stdout
    events = [json.loads(line)["event"] for line in Path("out/events.jsonl").read_text().splitlines()]
    made = [each for each in events if each["type"] == "plan-made"]
    assert [each["outcome"] for each in made[0]["branches"]] == ["good", "scrap"] and len(made) == 2


def test_a_policy_is_printed_as_json(sorting: Path) -> None:
    planned = json.loads(call("plan", "sort", "--json").stdout)
    assert planned["worst_s"] == planned["duration_s"] == 7.0
    assert [(each["outcome"], each["plan"][0]["arguments"]["to"]) for each in planned["branches"]] == [
        ("good", "lab:Rack"),
        ("scrap", "lab:Bin"),
    ]
    preview = msgspec.convert({**planned, "sequence": 0, "text": ""}, PlanPreview)
    assert [each.plan and each.plan[0].skill for each in preview.branches] == ["Bring", "Bring"]
    assert call("plan", "sort", "--minimise", "makespan").stdout.count("Bring") == 2


def test_classical_planners_get_an_action_for_each_outcome(sorting: Path) -> None:
    call("compile", ".", "-o", "build")
    domain = Path("build/domain.pddl").read_text(encoding="utf-8")
    assert "-> good, an outcome" in domain and "-> scrap, an outcome" in domain


TRUTH = "\nskillc:truth {{ lab:Part-1 sorting:grade sorting:Grade-{} . }}\n"


@pytest.mark.parametrize(("grade", "place"), [("Good", "lab:Rack"), ("Scrap", "lab:Bin")])
def test_a_look_finds_what_is_true_and_plans_do_not_know_it(sorting: Path, grade: str, place: str) -> None:
    scene = sorting / "sorting.ttl"
    prefix = "@prefix skillc: <https://w3id.org/skillc/core#> .\n"
    scene.write_text(prefix + scene.read_text() + TRUTH.format(grade), encoding="utf-8")
    call("check")
    assert len(json.loads(call("plan", "sort", "--json").stdout)["branches"]) == 2
    call("run", "sort", "--out", "out", "--tick-timeout", "0")
    assert f"to: {place}" in call("why", "out").stdout
    assert "the same but for wall times" in call("replay", "--check", "out").stdout


def test_what_is_hidden_adds_to_what_is_known(sorting: Path) -> None:
    scene, vocabulary = sorting / "sorting.ttl", compile_valid(find_library(sorting)).vocabulary
    known = "@prefix skillc: <https://w3id.org/skillc/core#> .\n" + scene.read_text()
    hidden = "lab:Bin skiros:contain lab:Part-2 . lab:Part-2 a skiros:Product ; sorting:grade sorting:Grade-Good ."
    scene.write_text(f"{known}\nskillc:truth {{ {hidden} }}\n", encoding="utf-8")
    state = load_scene(scene, vocabulary)
    part, contain, lab = "http://example.org/lab#Part-2", vocabulary.expand("skiros:contain"), vocabulary.expand
    assert not state.exists(part) and state.reveal().holds(lab("lab:Bin"), contain, part)
    scene.write_text(format_scene(state, load_sheets(vocabulary)), encoding="utf-8")
    assert load_scene(scene, vocabulary).hidden == state.hidden, "a saved scene keeps it"
    there = state.with_changes(
        [AddIndividual(part, (lab("skiros:Product"),)), AddRelation(lab("lab:Rack"), contain, part)]
    )
    assert there.reveal().holds(lab("lab:Rack"), contain, part) and not there.reveal().holds(
        lab("lab:Bin"), contain, part
    )
    scene.write_text(f"{known}\nskillc:truth {{ lab:Part-1 sorting:colour 3 . }}\n", encoding="utf-8")
    assert "there is no" in call("check", code=1).stdout


RACK = """use skiros
prefix lab: <http://example.org/lab#>

class    Slot < Location
property isRefused(Location): Bool

skill Empty {
    in   rack: Location
    opt  text: Text = "Please empty the rack."
    outcome emptied: rack.isRefused == false and forall s: Slot (not s contain _ when rack hasA s)
    outcome refused: rack.isRefused == true
    duration 60 s
}

impl by_operator of Empty {
    run python "skillc_runtime.primitives.ask:AskOutcome"
}

skill Put {
    in    part: Product
    in    to:   Slot
    infer from: Location
    pre   from contain part
    pre   not to contain _
    post  to contain part
    post  not from contain part
}

test it_is_emptied {
    scene  "rack.ttl"
    start  Empty -> emptied
    do     Empty(rack: lab:Rack)
    expect not exists s: Slot (lab:Rack hasA s and s contain _) and lab:Slot-3 contain lab:Part-3
}

test it_is_refused {
    scene  "rack.ttl"
    start  Empty -> refused
    do     Empty(rack: lab:Rack)
    expect lab:Slot-1 contain lab:Part-1
}

test a_plan_empties_it {
    scene  "rack.ttl"
    start  Empty -> emptied
    goal   lab:Rack.isRefused == true or lab:Slot-1 contain lab:Part-3
    expect lab:Slot-1 contain lab:Part-3 and not lab:Slot-2 contain _
}
"""
IN_RACK = """@prefix lab: <http://example.org/lab#> .
@prefix own: <https://w3id.org/skillc/library/rack#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
lab:Rack a skiros:Location ; skiros:hasA lab:Slot-1, lab:Slot-2 .
lab:Slot-1 a own:Slot ; skiros:contain lab:Part-1 .
lab:Slot-2 a own:Slot ; skiros:contain lab:Part-2 .
lab:Slot-3 a own:Slot ; skiros:contain lab:Part-3 .
lab:Part-1 a skiros:Product .
lab:Part-2 a skiros:Product .
lab:Part-3 a skiros:Product .
"""


def test_an_answer_changes_many_facts(tmp_path: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    manifest = 'name = "rack"\nedition = 2\n\n[tool.run]\nbackend = "symbolic"\n'
    for name, text in (("skillc.toml", manifest), ("rack.skill", RACK), ("rack.ttl", IN_RACK)):
        (tmp_path / name).write_text(text, encoding="utf-8")
    call("check")
    assert "3 tests, all passed" in call("test").stderr


GRADES = """use skiros, cora
prefix lab: <http://example.org/lab#>

enum Grade { Good, Rework, Scrap }
property grade(Product): Grade

skill Look {
    in    robot: Robot
    in    part:  Product
    infer place: Location
    pre   robot at place
    pre   place contain part
    senses part.grade
    outcome good:   part.grade == Good  likely 0.8
    outcome rework: part.grade == Rework
    outcome scrap:  part.grade == Scrap  likely 0.05
    duration 2 s
}

task look_at_all {
    scene "cell.ttl"
    goal  forall p: Product (p has grade)
}

test what_is_known_is_not_looked_at {
    scene  "cell.ttl"
    start  Look -> scrap
    do     Look(robot: lab:R, part: lab:P1)
    expect lab:P1.grade == Scrap
}

test what_is_known_stays_known {
    scene  "cell.ttl"
    start  Look -> scrap
    do     Look(robot: lab:R, part: lab:P3)
    expect lab:P3.grade == Rework
}
"""
GRADED = """@prefix lab: <http://example.org/lab#> .
@prefix own: <https://w3id.org/skillc/library/grades#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix skillc: <https://w3id.org/skillc/core#> .
lab:R a skillc:FixedRobot ; skiros:at lab:Bench .
lab:Bench a skillc:Workstation ; skiros:contain lab:P1, lab:P2, lab:P3 .
lab:P1 a skiros:Product .
lab:P2 a skiros:Product .
lab:P3 a skiros:Product ; own:grade own:Grade-Rework .
"""


def test_values_of_an_enumeration_are_sensed(tmp_path: Path, own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    manifest = 'name = "grades"\nedition = 2\n\n[tool.run]\nbackend = "symbolic"\n'
    for name, text in (("skillc.toml", manifest), ("grades.skill", GRADES), ("cell.ttl", GRADED)):
        (tmp_path / name).write_text(text, encoding="utf-8")
    call("check")
    planned = json.loads(call("plan", "look_at_all", "--json").stdout)
    assert [each["outcome"] for each in planned["branches"]] == ["good", "rework", "scrap"]
    assert "P3" not in json.dumps(planned), "what is known is not looked at"
    assert "2 tests, all passed" in call("test").stderr
    assert "Look has ended with" in call("run", "look_at_all", "--tick-timeout", "0").stdout
