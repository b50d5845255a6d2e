"""One mistake in a new project, in its skills, its task or its scene, is one error."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

from skillc.cli.main import skillc
from skillc.services.library.libraries import load_vocabulary
from skillc_dsl.source import Span
from skillc_runtime.scene.suggestions import suggest

MISTAKES = {
    "a class that is removed": ("cell.skill", "class Panel < Button\n", "", "cell.skill", "unknown-class"),
    "a parent that is unknown": (
        "cell.skill",
        "class Panel < Button",
        "class Panel < Device",
        "cell.skill",
        "unknown-class",
    ),
    "a property that is renamed": (*("cell.skill", "panel.isOn", "panel.isPressed", "cell.skill", "unknown-property"),),
    "a class in the scene": ("cell.ttl", "a cell:Panel", "a cell:Pannel", "cell.ttl", "unknown-class"),
    "a property in the scene": ("cell.ttl", "contact:pressForce", "contact:presForce", "cell.ttl", "unknown-property"),
    "a class that nothing declares": ("cell.ttl", "a cell:Panel", "a cell:Plate", "cell.ttl", "unknown-class"),
    "the name of the project": ("skillc.toml", 'name = "cell"', 'name = "press"', "cell.ttl", "unknown-class"),
    "the scene of a task": ("tasks.skill", '"cell.ttl"', '"cel.ttl"', "tasks.skill", "unknown-scene"),
    "an argument without its name": (
        *("cell.skill", "MoveTo(arm, target: before)", "MoveTo(arm, before)", "cell.skill", "unknown-argument"),
    ),
    "a body without `do`": ("cell.skill", "    do seq {", "    seq {", "cell.skill", "syntax"),
}
HELP = {
    "the name of the project": "did you mean `press:Panel`?",
    "a class in the scene": "did you mean `cell:Panel`?",
    "a class that nothing declares": "declare the class in a .skill file or in an ontology",
    "the scene of a task": "did you mean `cell.ttl`?",
    "an argument without its name": "write `target: before`",
}


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Create a project."""
    folder = tmp_path_factory.mktemp("projects") / "cell"
    assert CliRunner().invoke(skillc, ["new", str(folder)]).exit_code == 0
    return folder


@pytest.mark.slow
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_in_a_project_is_one_error(project: Path, mistake: str) -> None:
    name, old, new, place, problem = MISTAKES[mistake]
    file = project / name
    text = file.read_text("utf-8")
    assert old in text
    file.write_text(text.replace(old, new, 1), "utf-8")
    try:
        found = json.loads(CliRunner().invoke(skillc, ["check", str(project), "--json"]).stdout)
    finally:
        file.write_text(text, "utf-8")
    (error,) = (each for each in found if each["severity"] == "error")
    assert (Path(error["path"]).name, error["name"]) == (place, problem)
    assert HELP.get(mistake, "") in error["help"]


def test_an_arm_is_not_suggested_for_a_panel() -> None:
    terms = load_vocabulary()
    wrong, place = "https://w3id.org/skillc/library/cell#Panel", Span("cell.ttl", 1, 1, 1, 2)
    assert any(iri.endswith("#Panda") for iri in terms.classes)
    assert suggest(wrong, place, terms, terms.classes).help == ""
    assert suggest(wrong.replace("Panel", "Pandda"), place, terms, terms.classes).help == "did you mean `skillc:Panda`?"
