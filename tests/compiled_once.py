"""Compiles a library once for all tests in a process that read the same files of it."""

from __future__ import annotations

from collections.abc import Hashable
from pathlib import Path

from skillc.services import libraries
from skillc.services.library_files import SHIPPED, LibraryFiles
from skillc_dsl.diagnostics import Outcome
from skillc_model.skills import SkillLibrary

TESTS = Path(__file__).parent
compile_anew = libraries.compile_library
_known: dict[Hashable, Outcome[SkillLibrary]] = {}
_MOST = 20


def compile_once(files: LibraryFiles, *more: object) -> Outcome[SkillLibrary]:
    """Return what `compile_library` returns; from before if nothing that it reads can have changed.

    A project and a library with Python code of its own are always compiled anew, and where more is given to compile.
    """
    if more or files.project is not None or not (_stays(files.root) or _has_no_code(files.root)):
        return compile_anew(files, *more)
    # Diagnostics have paths relative to the current folder.
    texts = (files.sources, files.vocabularies, *map(_items, (files.importable, files.places, files.namespaces)))
    key = (files.name, files.root.resolve(), Path.cwd(), texts)
    _known[key] = _known.pop(key, None) or compile_anew(files)
    if len(_known) > _MOST:
        del _known[next(iter(_known))]
    return _known[key]


def _stays(root: Path) -> bool:
    return any(root.resolve().is_relative_to(place) for place in (SHIPPED, TESTS))


def _has_no_code(root: Path) -> bool:
    return next(root.rglob("*.py"), None) is None


def _items(table: object) -> Hashable:
    assert isinstance(table, dict)
    return tuple(sorted(table.items()))
