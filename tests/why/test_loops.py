"""A body with loops as a user meets it: all outputs tell each call with its round, and where values come from."""

from __future__ import annotations

import json
from pathlib import Path
from textwrap import dedent

import pytest

import skillc as api
from skillc.services.recording.recordings import make_result
from why.projects import ask_why, invoke, write_project

pytestmark = pytest.mark.slow

SKILLS = """use skiros

property patience(Product): Time
property isVisited(Product): Bool

skill Rest {
    in  spell: Time
    opt extra: Time = 0.1 s  range 0 s .. 1 s
    noplan
}
impl still of Rest { do wait spell }

skill Visit {
    in thing: Product
    post seen: thing.isVisited == true
}
impl twice of Visit {
    let half = 0.5 * thing.patience
    do seq {
        Rest(spell: half)
        Rest(spell: thing.patience, extra: 0.2 s)
        apply seen
    }
}

skill Wear {
    in thing: Product
    post worn: thing.patience == 0.8 s
}
impl at_once of Wear { do apply worn }

skill Tire {
    in thing: Product
    post seen: thing.isVisited == true
    post worn: thing.patience == 0.8 s
}
impl by_rest of Tire {
    let half = 0.5 * thing.patience
    do seq {
        Wear(thing)
        Rest(spell: half)
        apply seen
    }
}
"""
TASKS = """import "skills.skill"
prefix lab: <http://example.org/lab#>

task rounds {
    scene "scene.ttl"
    do seq {
        repeat 2 { seq { Visit(thing: lab:crate)  Visit(thing: lab:box) } }
        if lab:crate.isVisited == false { Visit(thing: lab:crate) }
        retry 2 { seq { Visit(thing: lab:crate)  check(lab:lid.isVisited == true) } }
        Visit(thing: lab:lid)
    }
}
"""
SCENE = """@prefix lab: <http://example.org/lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix own: <https://w3id.org/skillc/library/rounds#> .
lab:crate a skiros:Product ; own:patience 0.2 ; own:isVisited false .
lab:box a skiros:Product ;
    own:patience 0.4 ; own:isVisited false .
lab:lid a skiros:Product ; own:patience 0.4 ; own:isVisited false .
"""
ROUNDS = ["round 1 of repeat 2"] * 2 + ["round 2 of repeat 2"] * 2 + ["round 1 of retry 2", "round 2 of retry 2", ""]
STATES = ["success"] * 6 + ["not started"]


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a project in which a task with loops has run, and failed at its second loop."""
    files = {"skills.skill": SKILLS, "tasks.skill": TASKS, "scene.ttl": SCENE}
    folder = write_project(tmp_path_factory.mktemp("rounds") / "rounds", files)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        patch.setenv("COLUMNS", "160")
        told = invoke("run", "rounds", "--backend", "kinematic", "--out", "out", "--no-film").stdout
    (folder / "table.txt").write_text(told, encoding="utf-8")
    return folder


def test_the_table_has_each_call_with_its_round_in_order_of_time(project: Path) -> None:
    lines = (project / "table.txt").read_text(encoding="utf-8").splitlines()
    rows = [line.split(maxsplit=3) for line in lines if line.split()[1:2] == ["Visit"]]
    assert [row[0] for row in rows] == list("1234567")
    assert [row[3] for row in rows] == [f"twice, {each}" if each else "started  not reached" for each in ROUNDS]
    assert "achieved already" not in "\n".join(lines)


def test_all_outputs_tell_the_same(project: Path) -> None:
    run = api.open_run(project / "out")
    frame = run.to_frame("steps")
    assert (list(frame["rounds"]), list(frame["status"])) == (ROUNDS, STATES)
    assert list(frame["start_s"].dropna()) == sorted(frame["start_s"].dropna())
    story = json.loads(invoke("why", project / "out", "--json").stdout)
    told = [
        (step["number"], step["status"], step.get("started"))
        for attempt in story["attempts"]
        for step in attempt["steps"]
    ]
    assert told == [(step.number, step.status, step.start_s) for step in run.steps]
    page = (project / "out" / "report.html").read_text(encoding="utf-8")
    assert all(f"{step.number} {step.skill}</td>" in page for step in run.steps)
    assert page.count("round 2: ") == 2, "of the tree"


def test_the_result_is_that_of_the_events_alone(project: Path) -> None:
    run = api.open_run(project / "out")
    again = make_result(run.events, "the run")
    same = ("plan", "choices", "planned_steps", "planner", "replanned", "failure", "cause", "failed_calls", "status")
    assert {name: getattr(again, name) for name in same} == {name: getattr(run.result, name) for name in same}
    assert len(again.plan) == len(STATES)


@pytest.mark.parametrize(
    ("question", "answer"),
    [
        (
            "4.2.spell",
            """
            spell = 0.4 s  (passed by the caller: `thing.patience`, skills.skill:21)
              lab:box.patience == 0.4 s  (scene.ttl:6)
              thing of 4 = lab:box  (passed by the caller: `lab:box`, tasks.skill:7)
            """,
        ),
        (
            "1.1.spell",
            """
            spell = 0.1 s  (passed by the caller: `half`, skills.skill:20)
              half  (a `let`: `0.5 * thing.patience`, skills.skill:17)
                lab:crate.patience == 0.2 s  (scene.ttl:4)
                thing of 1 = lab:crate  (passed by the caller: `lab:crate`, tasks.skill:7)
            """,
        ),
        ("1.1.extra", "extra = 0.1 s  (the default: `0.1 s`, skills.skill:8)"),
        ("5.2.extra", "extra = 0.2 s  (passed by the caller: `0.2 s`, skills.skill:21)"),
    ],
)
def test_a_value_is_followed_to_the_line_of_the_scene(
    project: Path, monkeypatch: pytest.MonkeyPatch, question: str, answer: str
) -> None:
    monkeypatch.chdir(project)
    assert ask_why("out", question) == dedent(answer).strip()


def test_a_let_is_told_with_what_it_has_read_also_if_that_has_changed_since(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(project)
    wanted = ("--call", "Tire(thing: lab:box)", "--scene", "scene.ttl", "--library", ".")
    invoke("run", *wanted, "--backend", "kinematic", "--out", "tired", "--no-film")
    (origin,) = json.loads(invoke("why", "tired", "1.2.spell", "--json").stdout)["origins"]
    assert origin["value"] == {"type": "quantity", "value": 0.2, "unit": "s"}
    (let,) = origin["names"]
    assert [each["known"]["fact"]["value"]["value"] for each in let["facts"]] == [0.4]


def test_the_origin_is_data_too(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(project)
    (origin,) = json.loads(invoke("why", "out", "4.2.spell", "--json").stdout)["origins"]
    assert (origin["how"], origin["text"], origin["source"]["line"]) == ("passed", "thing.patience", 21)
    (fact,) = origin["facts"]
    assert fact["place"] == {"path": "scene.ttl", "line": 6, "column": 18}
    (thing,) = origin["names"]
    assert (thing["call"], thing["source"]["path"]) == ("4", "tasks.skill")
