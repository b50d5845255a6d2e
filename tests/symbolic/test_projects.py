"""A project whose tasks have no bodies is compiled, and its scene is edited, without what only bodies need."""

from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc

SKILLS = """use skiros, skillc
class Cart < MobileRobot
skill Drive {
    in    cart: Cart
    in    to:   Location
    infer from: Location
    pre   cart at from and not from == to
    post  cart at to
    post  not cart at from
    duration 20 s
}
"""
SCENE = """@prefix depot: <https://w3id.org/skillc/library/depot#> .
@prefix lab: <http://example.org/lab#> .
@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .
lab:Scene a skiros:Scene ; skiros:contain lab:Dock, lab:Hall .
lab:Dock a skiros:Location . lab:Hall a skiros:Location .
lab:Cart-1 a depot:Cart ; skiros:at lab:Dock .
"""
PROJECT = 'name = "depot"\nversion = "1.0.0"\nedition = 2\nscene = "hall.ttl"\n[tool.run]\nbackend = "symbolic"\n'


@pytest.fixture(autouse=True)
def depot(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for name, text in (("depot.skill", SKILLS), ("hall.ttl", SCENE), ("skillc.toml", PROJECT)):
        (tmp_path / name).write_text(text, "utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def ask(*arguments: str) -> str:
    """Return what a command prints, which succeeds."""
    done = CliRunner().invoke(skillc, arguments)
    assert done.exit_code == 0, done.output
    return done.output


def test_its_skills_are_actions_of_the_planning_domain(depot: Path) -> None:
    said = ask("compile", "-o", "made")
    assert "no-implementation" not in said
    domain = (depot / "made/domain.pddl").read_text("utf-8")
    assert "(:action drive" in domain and "left out" not in domain


def test_its_scene_is_edited_and_listed(depot: Path) -> None:
    ask("scene", "edit", "hall.ttl", "not lab:Cart-1 at lab:Dock", "lab:Cart-1 at lab:Hall")
    assert "skiros:at lab:Hall" in (depot / "hall.ttl").read_text("utf-8")
    assert "lab:Hall" in ask("world", "hall.ttl", "--show", "lab:Cart-1")
