"""In a project, commands work from any folder, the folder's name means nothing, and defaults come from the manifest."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from projects.folders import MANIFEST, call, checked, write_project

IRI = "https://w3id.org/skillc/library/sorting#"


@pytest.fixture
def project(tmp_path: Path) -> Path:
    folder = write_project(tmp_path / "work")
    (folder / "notes/old").mkdir(parents=True)
    return folder


def test_a_project_has_no_problem_from_any_folder(project: Path) -> None:
    assert checked(project) == checked(project / "notes/old") == checked(project.parent, project) == []


def test_a_problem_is_shown_relative_to_the_current_folder(project: Path) -> None:
    (project / "bad.skill").write_text("use skiros\nclass A < Prodct\n", "utf-8")
    assert [each["path"] for each in checked(project)] == ["bad.skill"]
    assert [each["path"] for each in checked(project / "notes")] == ["../bad.skill"]


@pytest.mark.slow
@pytest.mark.parametrize("command", ["plan", "world", "compile"])
def test_the_name_of_the_folder_means_nothing(command: str, project: Path, tmp_path: Path) -> None:
    arguments = {"plan": ["plan", "--json"], "world": ["world", "--json"], "compile": ["compile", "-o", "../out"]}
    before = call(project / "notes", *arguments[command])
    assert before.exit_code == 0, before.output
    moved = project.rename(tmp_path / "Another Name")
    after = call(moved / "notes", *arguments[command])
    assert (after.exit_code, after.stdout) == (0, before.stdout)


def test_terms_have_the_namespace_of_the_manifest(project: Path) -> None:
    assert call(project, "compile", "-o", "out").exit_code == 0
    assert f"{IRI}Mark" in json.loads((project / "out/library.json").read_text())["vocabulary"]["classes"]
    own = "https://example.org/mine/"
    (project / "skillc.toml").write_text(f'{MANIFEST}namespace = "{own}"\n', "utf-8")
    assert call(project, "compile", "-o", "out").exit_code == 0
    library = json.loads((project / "out/library.json").read_text())
    assert library["namespace"] == own and f"{own}Mark" in library["vocabulary"]["classes"]
    assert f"@prefix : <{own}>" in (project / "out/skills.ttl").read_text()
    scene = "@prefix m: <https://example.org/mine/> .\n@prefix lab: <http://example.org/lab#> .\nlab:M a m:Mark .\n"
    (project / "own.ttl").write_text(scene, "utf-8")
    assert call(project / "notes", "world", "own.ttl").stdout.startswith("lab:M  a sorting:Mark")


def test_a_task_is_found_here_then_among_the_shipped(project: Path) -> None:
    own = call(project / "notes", "plan", "hold_here", "--json")
    assert [step["skill"] for step in json.loads(own.stdout)["plan"]] == ["Pick"]
    assert call(project, "plan", "--json").stdout == own.stdout, "the default task"
    shipped = call(project, "plan", "clean_table", "--json")
    assert [step["skill"] for step in json.loads(shipped.stdout)["plan"]] == ["Pick", "Wipe"]
    missing = call(project, "plan", "hold_eraserr")
    assert missing.exit_code == 2 and "did you mean `hold_eraser`" in missing.stderr
    assert "no task" in call(project.parent, "plan", "hold_here").stderr


def test_a_goal_uses_the_library_and_scene_of_the_project(project: Path) -> None:
    planned = call(project / "notes", "plan", "--goal", "lab:Robotiq-1 contain lab:Eraser-1", "--json")
    assert [step["skill"] for step in json.loads(planned.stdout)["plan"]] == ["Pick"]
    without = call(project.parent, "plan", "--goal", "lab:Robotiq-1 contain lab:Eraser-1")
    assert without.exit_code == 2 and "--scene" in without.stderr


def test_goals_and_calls_of_the_manifest_are_tasks(project: Path) -> None:
    keep = '[tasks.keep]\ngoal = "lab:Robotiq-1 contain lab:Eraser-1"\n'
    text = f'{keep}[tasks.bad]\ncall = "Pick(arm: lab:Iiwa-1, object: lab:Nothing)"\n'
    (project / "skillc.toml").write_text(f"{MANIFEST}{text}", "utf-8")
    assert json.loads(call(project / "notes", "plan", "keep", "--json").stdout)["plan"]
    (found,) = checked(project)
    assert found["line"] == 8 and "lab:Nothing" in found["message"]
    assert call(project, "run", "bad").exit_code == 1


def test_a_key_of_an_earlier_version_is_told_how_it_is_called_now(project: Path) -> None:
    (project / "skillc.toml").write_text(f'{MANIFEST}[tasks.hold]\nskill = "Hold()"\n', "utf-8")
    (found,) = checked(project)
    assert found["name"] == "unknown-key" and "it is called `call` now" in str(found)


def test_a_task_of_steps_is_listed_with_the_skills_that_it_calls(project: Path) -> None:
    steps = "Second(arm: lab:A)\n retry 2 { First(arm: lab:A) }\n Second(arm: lab:A)"
    (project / "steps.skill").write_text(f'task steps {{ scene "iiwa_table.ttl" do seq {{ {steps} }} }}\n', "utf-8")
    listed = json.loads(call(project, "tasks", "--json").stdout)
    assert [each["aim"] for each in listed if each["name"] == "steps"] == ["Second, First"]


@pytest.mark.slow
def test_tasks_are_listed_here_and_shipped(project: Path) -> None:
    listed = json.loads(call(project / "notes", "tasks", "--json").stdout)
    own = [each for each in listed if each["origin"] == "project"]
    assert [(each["name"], each["scene"], each["is_default"]) for each in own] == [
        ("hold_eraser", "iiwa_table.ttl", True),
        ("hold_here", "iiwa_table.ttl", False),
    ]
    assert own[0]["doc"] == "Hold the eraser." and own[0]["aim"] == "lab:Robotiq-1 contain lab:Eraser-1"
    names = {each["name"] for each in listed}
    assert {"clean_table", "contact:insert_peg"} <= names
    outside = json.loads(call(project.parent, "tasks", "--json").stdout)
    assert {each["name"] for each in outside} == names - {each["name"] for each in own}
    for each in outside[:2] + outside[-2:]:
        assert call(project.parent, "plan", each["name"]).exit_code in (0, 2), each
    table = call(project, "tasks").stdout
    assert "* hold_eraser" in table and not any(line.endswith(" ") for line in table.splitlines())


def test_defaults_of_options_come_from_the_manifest_and_the_command_line_wins(project: Path) -> None:
    (project / "skillc.toml").write_text(f'{MANIFEST}[tool.plan]\nminimise = "makespan"\n', "utf-8")
    refused = call(project / "notes", "plan", "--prove")
    assert refused.exit_code == 2 and "requires to minimise work" in refused.stderr
    assert call(project, "plan", "--prove", "--minimise", "work").exit_code == 0


def test_a_file_of_a_project_has_its_name(project: Path) -> None:
    assert checked(project, "tasks.skill") == []
    scene = f"@prefix s: <{IRI}> .\n@prefix lab: <http://example.org/lab#> .\nlab:M a s:Mark .\n"
    (project / "own.ttl").write_text(scene, "utf-8")
    assert checked(project, "tasks.skill", "--scene", "own.ttl") == []


def test_other_projects_and_virtual_environments_inside_do_not_belong_to_it(project: Path) -> None:
    write_project(project / "other", MANIFEST.replace("sorting", "other"))
    (project / "venv/lib").mkdir(parents=True)
    (project / "venv/pyvenv.cfg").touch()
    (project / "venv/lib/broken.skill").write_text("class", "utf-8")
    assert checked(project) == []
    assert call(project / "venv/lib", "plan").exit_code == 2


def test_ontology_folders_of_the_manifest_are_read_and_left_again(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("SKILLC_ONTOLOGY", raising=False)
    (project / "ontology/vocabulary").mkdir(parents=True)
    text = (
        "@prefix owl: <http://www.w3.org/2002/07/owl#> .\n@prefix shop: <http://example.org/shop#> .\n"
        "<http://example.org/shop> a owl:Ontology .\nshop:Item a owl:Class .\n"
    )
    (project / "ontology/vocabulary/shop.ttl").write_text(text, "utf-8")
    (project / "items.skill").write_text("use shop\nclass Box < Item\n", "utf-8")
    assert [each["name"] for each in checked(project)] == []
    (project / "skillc.toml").write_text(f'{MANIFEST}ontology = ["ontology"]\n', "utf-8")
    assert checked(project / "notes") == []
    outside = project.parent / "items.skill"
    outside.write_text("use shop\nclass Box < Item\n", "utf-8")
    assert "unknown-vocabulary" in [each["name"] for each in checked(project.parent, "items.skill")]
