"""The editor tells what `skillc check` tells, at the same places, and nothing of the shipped libraries."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from lsprotocol import types

from skillc.lsp.diagnostics import diagnostics_by_uri
from skillc.lsp.libraries import Libraries
from skillc.services.check import library_checks
from skillc.services.library.files import SHIPPED, find_library
from skillc_ontology import catalogue

CASES = Path(__file__).parents[1] / "cases" / "errors"


@pytest.mark.parametrize("name", ["data_flow.skill", "authoring.skill", "quantities.skill", "ontology.skill"])
def test_a_file_has_the_same_problems(name: str, tmp_path: Path) -> None:
    file = Path(shutil.copy(CASES / name, tmp_path))
    checked = library_checks.check_library(find_library(tmp_path), None)
    told = problems(file)
    assert told
    assert told == {(d.name, d.span.line, d.span.column, d.message, d.help) for d in checked}


@pytest.mark.parametrize("name", ["std", "wiping"])
def test_a_shipped_library_has_none(name: str) -> None:
    assert problems(next((SHIPPED / name).glob("*.skill"))) == set()


def problems(file: Path) -> set[tuple[str, int, int, str, str]]:
    """Return what the editor is told when it opens a file of a folder that it has open."""
    libraries = Libraries((file.parent,))
    libraries.write(file.as_uri(), file.read_text("utf-8"))
    return {
        (d.name, d.span.line, d.span.column, d.message, d.help) for d in libraries.view(file.as_uri()).analysis.problems
    }


def test_a_scene_that_there_is_not_is_told(tmp_path: Path) -> None:
    file = tmp_path / "tasks.skill"
    file.write_text('task go {\n    scene "ur5e_whitebord.ttl"\n    goal  wiping:Board-1 is Thing\n}\n')
    libraries = Libraries((tmp_path,))
    libraries.write(file.as_uri(), file.read_text("utf-8"))
    view = libraries.view(file.as_uri())
    (problem,) = libraries.problems_of_scenes(view.root)
    assert (problem.name, problem.span.line, problem.span.column) == ("unknown-scene", 2, 11)
    assert "ur5e_whiteboard.ttl" in problem.help


def test_what_keeps_tasks_from_being_done_is_told_as_by_check(tmp_path: Path) -> None:
    file = tmp_path / "tasks.skill"
    file.write_text(
        'use wiping\nprefix lab: <http://example.org/lab#>\nimport "wiping/wipe.skill"\n'
        'task go {\n    scene "cell.ttl"\n    goal  lab:Table-1.isClean == true\n}\n'
        'task look {\n    scene "cell.ttl"\n    do    Wipe(surface: lab:Table-1)\n}\n'
    )
    (tmp_path / "cell.ttl").write_text(catalogue.scene_path("iiwa_table").read_text("utf-8"), "utf-8")
    checked = library_checks.check_library(find_library(tmp_path), None)
    assert {d.name for d in checked} == {"unreachable-goal", "no-answer"}
    libraries = Libraries((tmp_path,))
    libraries.write(file.as_uri(), file.read_text("utf-8"))
    told = libraries.problems_of_scenes(libraries.view(file.as_uri()).root)
    assert {(d.name, d.span.line, d.span.column, d.message) for d in told} == {
        (d.name, d.span.line, d.span.column, d.message) for d in checked
    }


def test_columns_in_scenes_are_those_of_check(tmp_path: Path) -> None:
    file, scene = tmp_path / "tasks.skill", tmp_path / "cell.ttl"
    file.write_text('task go {\n    scene "cell.ttl"\n    goal  wiping:Board-1 is Thing\n}\n')
    scene.write_text(
        "@prefix skiros: <http://rvmi.aau.dk/ontologies/skiros.owl#> .\nskiros:Shelf a skiros:Lokation .\n"
    )
    libraries = Libraries((tmp_path,))
    libraries.write(file.as_uri(), file.read_text("utf-8"))
    view = libraries.view(file.as_uri())
    (told,) = diagnostics_by_uri(libraries, view.root, view.analysis, libraries.problems_around(view.root), "utf-16")[
        scene.as_uri()
    ]
    assert told.range == types.Range(types.Position(1, 15), types.Position(1, 30))


def test_a_prefix_of_the_authors_own_is_that_of_no_scene(tmp_path: Path) -> None:
    file = tmp_path / "tasks.skill"
    text = (
        'use wiping\nprefix lab: <http://example.org/lab#>\nimport "wiping/wipe.skill"\n'
        'task go {\n    scene "iiwa_table.ttl"\n    goal  lab:Table-1.isClean == true\n}\n'
    )
    libraries = Libraries((tmp_path,))
    for written, expected in ((text, {"unreachable-goal"}), (text.replace("lab#", "lab"), {"unknown-individual"})):
        file.write_text(written)
        libraries.write(file.as_uri(), written)
        root = libraries.view(file.as_uri()).root
        shown = {each.name for each in (*libraries.analysis(root).problems, *libraries.problems_of_scenes(root))}
        checked = {each.name for each in library_checks.check_library(find_library(tmp_path), None)}
        assert shown == checked == expected


def test_a_byte_order_mark_is_no_part_of_the_text(tmp_path: Path) -> None:
    file = tmp_path / "one.skill"
    text = "\ufeffskill Rest { noplan }\n"
    file.write_text(text, "utf-8")
    checked = library_checks.check_library(find_library(tmp_path), None)
    libraries = Libraries((tmp_path,))
    libraries.write(file.as_uri(), text)
    shown = libraries.view(file.as_uri()).analysis.problems
    assert shown
    assert [(each.name, each.span.line) for each in shown] == [(each.name, each.span.line) for each in checked]


def test_a_project_is_what_it_is_for_check(tmp_path: Path) -> None:
    (tmp_path / "parts/sub").mkdir(parents=True)
    (tmp_path / "parts/skillc.toml").write_text('name = "parts"\n', "utf-8")
    (tmp_path / "parts/terms.skill").write_text("use skiros\nclass Bolt < Product\n", "utf-8")
    manifest = tmp_path / "skillc.toml"
    manifest.write_text('name = "mine"\n[dependencies]\nparts = { path = "parts" }\n', "utf-8")
    file = tmp_path / "nuts.skill"
    file.write_text('import "parts/terms.skill"\nclass Nut < Bolt\nclass Wheel < Bold\n', "utf-8")
    libraries = Libraries(())
    libraries.write(file.as_uri(), file.read_text("utf-8"))
    (problem,) = libraries.view(file.as_uri()).analysis.problems
    assert (problem.name, problem.span.line) == ("unknown-class", 3)
    assert (
        "https://w3id.org/skillc/library/mine#Nut" in libraries.view(file.as_uri()).analysis.program.vocabulary.classes
    )
    manifest.write_text('name = "mine"\n[dependencys]\n', "utf-8")
    libraries.forget(manifest)
    root = libraries.view(file.as_uri()).root
    told = diagnostics_by_uri(libraries, root, libraries.analysis(root), libraries.problems_around(root), "utf-16")
    assert [(each.code, each.range.start.line) for each in told[manifest.as_uri()]] == [("unknown-key", 1)]
