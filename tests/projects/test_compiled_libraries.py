"""A library that has not changed is not compiled again, and one that has is."""

from __future__ import annotations

from pathlib import Path

import pytest

from skillc.errors import DiagnosticsError
from skillc.services.library import libraries
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import SHIPPED, LibraryFiles, find_library
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.source import Source
from skillc_model.skills import SkillLibrary


@pytest.fixture
def compiled(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> list[str]:
    """The names of the libraries that were compiled, with a cache of their own."""
    monkeypatch.setenv("SKILLC_CACHE", str(tmp_path / "cache"))
    names: list[str] = []
    compile_library = libraries.compile_library

    def noting(files: LibraryFiles) -> Outcome[SkillLibrary]:
        names.append(files.name)
        return compile_library(files)

    monkeypatch.setattr(libraries, "compile_library", noting)
    return names


def copy_wiping(folder: Path) -> Path:
    """Copy the shipped wiping library, with a name of its own."""
    copy = folder / "mine"
    copy.mkdir()
    for path in (SHIPPED / "wiping").glob("*.skill"):
        (copy / path.name).write_text(path.read_text("utf-8"), "utf-8")
    return copy


def test_what_is_compiled_once_is_the_same_from_the_cache(compiled: list[str]) -> None:
    files = find_library(SHIPPED / "contact")
    first, again = compile_valid(files), compile_valid(files)
    assert (first, compiled) == (again, ["contact"])
    assert first.hash == again.hash


def test_it_is_the_same_wherever_it_is_and_whatever_its_scenes_say(
    compiled: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = []
    for place in ("here", "there"):
        (tmp_path / place).mkdir()
        monkeypatch.chdir(tmp_path / place)
        folder = copy_wiping(tmp_path / place)
        (folder / "tasks.skill").write_text('task go {\n    scene "cell.ttl"\n    do wait 1 s\n}\n', "utf-8")
        (folder / "cell.ttl").write_text(f"# {place}\n", "utf-8")
        found.append(compile_valid(find_library(folder)))
    assert found[0] == found[1] and compiled == ["mine"]


def test_a_change_of_a_text_of_what_it_imports_or_of_a_vocabulary_is_seen(compiled: list[str], tmp_path: Path) -> None:
    folder = copy_wiping(tmp_path)
    compile_valid(find_library(folder))
    for path in (*sorted(folder.glob("*.skill"))[:1], folder / "terms.ttl"):
        with path.open("a", encoding="utf-8") as file:
            file.write("\n# changed\n" if path.suffix == ".skill" else ONTOLOGY)
        compile_valid(find_library(folder))
    files = find_library(folder)
    name, imported = next(iter(files.importable.items()))
    changed = Source(imported.path, imported.text + "\n# changed\n")
    compile_valid(files._replace(importable={**files.importable, name: changed}))
    assert compiled == ["mine"] * 4


ONTOLOGY = """@prefix owl: <http://www.w3.org/2002/07/owl#> .
<http://example.org/terms> a owl:Ontology .
<http://example.org/terms#Cloth> a owl:Class .
"""


def test_errors_are_found_each_time(compiled: list[str], tmp_path: Path) -> None:
    folder = copy_wiping(tmp_path)
    (folder / "wrong.skill").write_text("skill Wrong {", "utf-8")
    for _ in range(2):
        with pytest.raises(DiagnosticsError):
            compile_valid(find_library(folder))
    assert compiled == ["mine"] * 2


def test_a_damaged_entry_is_written_again(compiled: list[str], tmp_path: Path) -> None:
    files = find_library(SHIPPED / "contact")
    first = compile_valid(files)
    (entry,) = (tmp_path / "cache" / "library").iterdir()
    entry.write_bytes(entry.read_bytes()[:-10])
    assert compile_valid(files) == first
    assert compile_valid(files) == first
    assert compiled == ["contact"] * 2
