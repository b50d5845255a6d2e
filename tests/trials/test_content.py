"""An experiment has all that it needs: the scene, and the user's data sheets, models and meshes."""

from __future__ import annotations

from contextvars import copy_context
from pathlib import Path

import pytest
from msgspec.structs import replace

from skillc.services.library import compiled_libraries
from skillc.services.library.files import SHIPPED, find_library
from skillc_model import codec
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.evaluation.trials.content import Experiment, prepare_runner, read_folders
from skillc_runtime.evaluation.trials.experiment import TrialRunner
from skillc_runtime.scene.load import load_scene

TASK = "press_button"
SHEET = """
@prefix skillc: <https://w3id.org/skillc/core#> .
@prefix : <http://example.org/own#> .
:{name} a skillc:ToolSheet ; skillc:model "tools/own.xml" ; skillc:padDamping 1.0 ; skillc:padStiffness 1.0 .
"""


@pytest.fixture(scope="module")
def library() -> SkillLibrary:
    return compiled_libraries.compile_valid(find_library(SHIPPED / "contact"))


def make_folder(place: Path, sheet: str) -> Path:
    """Make an ontology folder with a data sheet, and a model that is none."""
    (place / "tools").mkdir(parents=True)
    (place / "tools/own.ttl").write_text(sheet)
    (place / "tools/own.xml").write_text(f"<mujoco model='{place.name}'/>")
    return place


def make_experiment(library: SkillLibrary, scene: Path) -> Experiment:
    folders = read_folders(load_scene(scene, library.vocabulary))
    content = {"library": codec.dumps(library), "scene_name": scene.name, "scene": scene.read_bytes()}
    return Experiment(task=TASK, disturbance="none", folders=folders, **content)


def prepare(experiment: Experiment) -> tuple[TrialRunner, str]:
    """Make a runner as a process of its own does; return it with the model that it finds."""
    runner = prepare_runner(experiment)
    return runner, catalogue.model_path("tools/own.xml").read_text()


def test_a_scene_is_read_with_the_folders_that_were_sent_and_no_others(
    library: SkillLibrary, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    here, there = (make_folder(tmp_path / name, SHEET.format(name=name)) for name in ("here", "there"))
    scene = catalogue.scene_path(library.tasks[TASK].scene or "")
    monkeypatch.setenv(catalogue.VARIABLE, str(here))
    experiment = make_experiment(library, scene)
    monkeypatch.setenv(catalogue.VARIABLE, str(there))
    runner, model = copy_context().run(prepare, experiment)
    own = {each for each in runner._state.individuals if each.startswith("http://example.org/own#")}
    assert (own, model) == ({"http://example.org/own#here"}, "<mujoco model='here'/>")
    assert catalogue.user_folders() == (there,)
    assert runner.run(0).status == "succeeded"


def test_a_change_of_anything_that_is_sent_is_another_experiment(
    library: SkillLibrary, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv(catalogue.VARIABLE, str(make_folder(tmp_path / "here", SHEET.format(name="here"))))
    scene = catalogue.scene_path(library.tasks[TASK].scene or "")
    first = make_experiment(library, scene)
    (tmp_path / "here/tools/own.xml").write_text("<mujoco/>")
    assert first.folders != read_folders(load_scene(scene, library.vocabulary))
    other = replace(first, folders=({**first.folders[0], "tools/own.xml": b"<mujoco/>"},))
    assert (other.library_digest, other.scene_digest == first.scene_digest) == (first.library_digest, False)
    assert replace(first, scene=first.scene + b"\n").scene_digest != first.scene_digest
