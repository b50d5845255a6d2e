"""No files import each other in a circle, not in functions and not for type checkers either.

import-linter keeps packages in their layers; a circle of files within one is as hard to read, to test and to move.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator, Mapping
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import grimp
import pytest

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
PACKAGES = PROJECT["tool"]["importlinter"]["root_packages"]


def read_imports(*packages: str) -> dict[str, set[str]]:
    """Return what each file imports, wherever that stands in it."""
    graph = grimp.build_graph(*packages, cache_dir=None)
    return {name: graph.find_modules_directly_imported_by(name) for name in graph.modules}


def cycles(imports: Mapping[str, set[str]]) -> Iterator[str]:
    """Yield circles, each as one line; those that share an import with one before are found once that is gone."""
    left = {name: set(others) for name, others in imports.items()}
    while True:
        try:
            TopologicalSorter(left).prepare()
            return
        except CycleError as error:
            circle = error.args[1][::-1]
        yield " imports ".join(circle)
        left[circle[0]].remove(circle[1])


def test_no_files_import_each_other_in_a_circle() -> None:
    imports = read_imports(*PACKAGES)
    assert len(imports) > 1000
    assert list(cycles(imports)) == [], "let both import what they share from a third file, or one of them a protocol"


def test_every_package_that_is_shipped_is_looked_at() -> None:
    shipped = PROJECT["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]
    assert sorted(PACKAGES) == sorted(path.rpartition("/")[2] for path in shipped)


def test_imports_in_functions_and_for_type_checkers_count(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (package := tmp_path / "circular_example").mkdir()
    (package / "__init__.py").touch()
    (package / "first.py").write_text("def work():\n    from circular_example import second\n")
    (package / "second.py").write_text("from circular_example import third\n")
    (package / "third.py").write_text(
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from circular_example.first import work\n"
    )
    monkeypatch.syspath_prepend(str(tmp_path))
    (found,) = cycles(read_imports("circular_example"))
    names = [each.rpartition(".")[2] for each in found.split(" imports ")]
    assert names[0] == names[-1]
    assert " ".join(names[:3]) in "first second third first second"
