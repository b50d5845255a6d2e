"""No folder has so many files that a reader has to search it: what belongs together has a folder of its own."""

from __future__ import annotations

import tomllib
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGES = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["tool"]["hatch"]["build"]["targets"]["wheel"][
    "packages"
]
MOST = 25

#: Each of their files is found by its name, and is one of many of a kind.
DISCOVERED = frozenset({
    "app/skillc/cli/commands",
    "compiler/skillc_compiler/checks",
    "runtime/skillc_runtime/primitives",
})  # fmt: skip


def count_files() -> Counter[str]:
    """Return how many Python files each folder of the product has, besides its `__init__.py`."""
    files = (path for package in PACKAGES for path in (ROOT / package).rglob("*.py") if path.name != "__init__.py")
    return Counter(path.parent.relative_to(ROOT).as_posix() for path in files)


def test_no_folder_has_more_than_25_loose_files() -> None:
    counts = count_files()
    assert len(counts) > 100
    full = {folder: count for folder, count in counts.items() if count > MOST and folder not in DISCOVERED}
    assert full == {}, "give what belongs together a folder of its own"


def test_folders_whose_files_are_discovered_are_full() -> None:
    assert all(count_files()[folder] > MOST for folder in DISCOVERED)
