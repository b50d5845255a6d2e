"""Where a value came from that is an output of a call, an item of a loop or an argument of the task."""

from __future__ import annotations

import json
from pathlib import Path
from textwrap import dedent

import pytest

from skillc_ontology.catalogue import ROOT
from why.projects import ask_why, invoke, write_project

pytestmark = pytest.mark.slow

SKILLS = """use skiros

property patience(Product): Time

## The things to visit.
function toVisit(first: Product) -> [Product] = python "looking:to_visit"
## How long to rest, twice.
function spells(first: Product) -> [Time] = python "looking:spells"

skill Rest {
    in  spell: Time
    noplan
}
impl still of Rest { do wait spell }

skill Look {
    in  thing: Product
    out spell: Time
    noplan
}
impl at_once of Look { run python "looking:Look" }

skill VisitAll {
    in first: Product
    noplan
}
impl one_by_one of VisitAll {
    do for each in toVisit(first) {
        seq {
            Look(thing: each) -> found
            Rest(spell: 0.5 * found)
            Rest(spell: each.patience)
        }
    }
}
"""
TASKS = """use skiros
import "skills.skill"
prefix lab: <http://example.org/lab#>

task rounds(first: Product, rest: Time) {
    scene "scene.ttl"
    do seq {
        Look(thing: first) -> seen
        Rest(spell: seen)
        Rest(spell: rest)
        Rest(spell: 2 * first.patience)
        for each in toVisit(first) { Rest(spell: each.patience) }
        for time in spells(lab:box) { Rest(spell: time) }
        sel {
            seq { Look(thing: lab:lid) -> seen  check(lab:lid is Location) }
            Look(thing: lab:box) -> seen
        }
        Rest(spell: seen)
        VisitAll(first)
    }
}
"""
PYTHON = """from skillc.primitives import Primitive, Status

LAB = "http://example.org/lab#"


class Look(Primitive):
    def __init__(self, cell, *, thing):
        super().__init__(cell)
        self.thing = thing

    def tick(self):
        self.outputs["spell"] = 0.1 if self.thing == LAB + "box" else 0.3
        return Status.SUCCESS


def to_visit(state, first):
    return [first, LAB + "lid"]


def spells(state, first):
    return [0.1, 0.2]
"""
SCENE = """@prefix lab: <http://example.org/lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
@prefix own: <https://w3id.org/skillc/library/rounds#> .
lab:crate a skiros:Product ; own:patience 0.2 .
lab:box a skiros:Product ; own:patience 0.4 .
lab:lid a skiros:Product ; own:patience 0.4 .
"""
QUESTIONS = {
    "output": (
        "2.spell",
        """
        spell = 0.3 s  (passed by the caller: `seen`, tasks.skill:9)
          seen = 0.3 s  (the output `spell` of call 1, tasks.skill:8)
        """,
    ),
    "output-of-the-branch-that-succeeded": (
        "11.spell",
        """
        spell = 0.1 s  (passed by the caller: `seen`, tasks.skill:18)
          seen = 0.1 s  (the output `spell` of call 10, tasks.skill:16)
        """,
    ),
    "output-in-a-loop": (
        "12.5.spell",
        """
        spell = 0.15 s  (passed by the caller: `0.5 * found`, skills.skill:31)
          found = 0.3 s  (the output `spell` of call 12.4, skills.skill:30)
        """,
    ),
    "argument-of-the-task": (
        "3.spell",
        """
        spell = 0.25 s  (passed by the caller: `rest`, tasks.skill:10)
          rest = 0.25 s  (an argument of the task)
        """,
    ),
    "argument-in-an-expression": (
        "4.spell",
        """
        spell = 0.4 s  (passed by the caller: `2 * first.patience`, tasks.skill:11)
          lab:crate.patience == 0.2 s  (scene.ttl:4)
          first = lab:crate  (an argument of the task)
        """,
    ),
    "item": (
        "6.spell",
        """
        spell = 0.4 s  (passed by the caller: `each.patience`, tasks.skill:12)
          lab:lid.patience == 0.4 s  (scene.ttl:6)
          each = lab:lid  (an item of the loop over: `toVisit(first)`, tasks.skill:12)
            first = lab:crate  (an argument of the task)
        """,
    ),
    "item-with-a-unit": (
        "8.spell",
        """
        spell = 0.2 s  (passed by the caller: `time`, tasks.skill:13)
          time = 0.2 s  (an item of the loop over: `spells(lab:box)`, tasks.skill:13)
        """,
    ),
    "item-in-a-skill": (
        "12.3.spell",
        """
        spell = 0.2 s  (passed by the caller: `each.patience`, skills.skill:32)
          lab:crate.patience == 0.2 s  (scene.ttl:4)
          each = lab:crate  (an item of the loop over: `toVisit(first)`, skills.skill:28)
            first of 12 = lab:crate  (passed by the caller: `first`, tasks.skill:19)
              first = lab:crate  (an argument of the task)
        """,
    ),
}


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a project in which a task with arguments has run."""
    files = {"skills.skill": SKILLS, "tasks.skill": TASKS, "looking.py": PYTHON, "scene.ttl": SCENE}
    folder = write_project(tmp_path_factory.mktemp("origins") / "rounds", files)
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        given = ("first=lab:crate", "rest=0.25 s", "--backend", "kinematic", "--out", "out", "--no-film")
        assert "succeeded" in invoke("run", "rounds", *given).stdout
    return folder


@pytest.mark.parametrize("kind", QUESTIONS)
def test_a_value_is_followed_through_outputs_loops_and_arguments(
    project: Path, monkeypatch: pytest.MonkeyPatch, kind: str
) -> None:
    monkeypatch.chdir(project)
    question, answer = QUESTIONS[kind]
    assert ask_why("out", question) == dedent(answer).strip()


def test_the_origin_as_data_has_the_value_of_each_name(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(project)
    (origin,) = json.loads(invoke("why", "out", "6.spell", "--json").stdout)["origins"]
    (item,) = origin["names"]
    (given,) = item["names"]
    assert (item["how"], item["value"]["label"], given["how"], given["value"]["label"]) == (
        "loop",
        "lab:lid",
        "given",
        "lab:crate",
    )


def test_a_shipped_scene_is_named_as_users_name_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    call = ("--call", "PressButton(button: lab:Button-1)", "--scene", "panda_button", "--library", "contact")
    invoke("run", *call, "--backend", "kinematic", "--out", "out", "--no-film")
    told = invoke("why", "out", "Push.force").stdout
    assert "  (panda_button.ttl:" in told and str(ROOT) not in told
