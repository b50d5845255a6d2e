"""Finds the packaged files (vocabularies, data sheets, scenes, models), and those in the user's ontology folders.

A user's folder has the layout of this package: data sheets in `robots`, `grippers`, `tools`, `fixtures` and `cameras`,
models beside them. All other ontology files in it are vocabularies.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path

from skillc_dsl.encoding import unpack

ROOT = Path(__file__).parent
SHEET_FOLDERS = ("robots", "grippers", "tools", "fixtures", "cameras")
VOCABULARY_FOLDERS = ("vocabulary", *SHEET_FOLDERS)
_PLAIN = (".ttl", ".owl", ".rdf", ".xml", ".nt", ".nq", ".trig", ".jsonld", ".ofn", ".omn", ".owx")
ENDINGS = (*_PLAIN, *(f"{ending}.gz" for ending in _PLAIN))
"""The ends of the names of files that may be vocabularies; those that end with `.gz` are compressed."""
VARIABLE = "SKILLC_ONTOLOGY"
"""The environment variable that lists the user's folders, separated as in PATH."""
_ADDED: ContextVar[tuple[Path, ...]] = ContextVar("added ontology folders", default=())
_REPLACED: ContextVar[bool] = ContextVar("whether the added ontology folders are all", default=False)


def vocabulary_files() -> tuple[tuple[str, str], ...]:
    """Return every packaged vocabulary and data sheet as (path below the ontology, Turtle text), in order of path."""
    return tuple((str(path.relative_to(ROOT)), path.read_text("utf-8")) for path in sorted(_vocabulary_paths()))


def user_folders() -> tuple[Path, ...]:
    """Return the user's ontology folders, each once: those that were added in this context, then the variable's."""
    named = [] if _REPLACED.get() else os.environ.get(VARIABLE, "").split(os.pathsep)
    return tuple(dict.fromkeys((*_ADDED.get(), *(Path(name) for name in named if name))))


def add_folders(folders: Iterable[Path]) -> None:
    """Put ontology folders first, until the innermost `folder_scope` around ends; other threads do not see them."""
    _ADDED.set(tuple(dict.fromkeys((*folders, *_ADDED.get()))))


def replace_folders(folders: Iterable[Path]) -> None:
    """Let these be the only ontology folders from now on, whatever the variable says; other threads do not see them."""
    _ADDED.set(tuple(folders))
    _REPLACED.set(True)


@contextmanager
def folder_scope(folders: Iterable[Path] = ()) -> Iterator[None]:
    """Add ontology folders in a `with` statement; those that are added inside are removed at its end too."""
    before = _ADDED.get()
    add_folders(folders)
    try:
        yield
    finally:
        _ADDED.set(before)


def make_environment() -> dict[str, str]:
    """Return the environment variables for a new process that shall see the same ontology folders."""
    folders = os.pathsep.join(map(str, user_folders()))
    return {**os.environ, VARIABLE: folders} if folders or VARIABLE in os.environ else dict(os.environ)


def user_files() -> tuple[tuple[str, Path], ...]:
    """Return every file in the user's folders that may be a vocabulary, by `folder/path`.

    Hidden folders are skipped, and what else may be XML: models, catalogues of ontologies, packages of ROS.
    """
    found = (
        (folder, path) for folder in user_folders() for path in sorted(folder.rglob("*")) if path.name.endswith(ENDINGS)
    )
    below = ((folder, path, path.relative_to(folder)) for folder, path in found)
    return tuple(
        (f"{folder.resolve().name}/{inner.as_posix()}", path)
        for folder, path, inner in below
        if not any(part.startswith(".") for part in inner.parts) and not _is_other_xml(path)
    )


def sheet_files() -> tuple[tuple[str, str], ...]:
    """Return the texts that are part of every world: the packaged files and the user's data sheets, in any format."""
    places = (folder / name for folder in user_folders() for name in SHEET_FOLDERS)
    own = (
        path
        for place in places
        for path in sorted(place.glob("*"))
        if path.name.endswith(ENDINGS) and not _is_other_xml(path)
    )
    return (
        *vocabulary_files(),
        *((str(path), unpack(path.read_bytes()).decode("utf-8", errors="replace")) for path in own),
    )


def scene_names() -> tuple[str, ...]:
    """Return the names of the shipped scenes, with their suffix."""
    return tuple(sorted(path.name for path in (ROOT / "scenes").glob("*.ttl")))


def scene_path(name: str) -> Path:
    """Return the path of a shipped scene, with or without `.ttl`; FileNotFoundError names the nearest ones."""
    file = name if name.endswith(".ttl") else f"{name}.ttl"
    if file not in scene_names():
        from difflib import get_close_matches

        near = get_close_matches(file, scene_names())
        hint = f"did you mean {' or '.join(near)}?" if near else f"those are {', '.join(scene_names())}"
        raise FileNotFoundError(f"no shipped scene {name}; {hint}")
    return ROOT / "scenes" / file


def model_path(path: str) -> Path:
    """Return the path of a model that a data sheet names (`robots/ur5e.xml`); FileNotFoundError if there is none."""
    places = (ROOT, *user_folders())
    found = next((place / path for place in places if (place / path).is_file()), None)
    if found is None:
        raise FileNotFoundError(f"there is no model {path} in the ontology")
    return found


def user_models() -> tuple[Path, ...]:
    """Return the model files in the user's folders."""
    places = (folder / name for folder in user_folders() for name in SHEET_FOLDERS)
    return tuple(path for place in places for path in sorted(place.glob("*.xml")))


def _vocabulary_paths() -> Iterator[Path]:
    for folder in VOCABULARY_FOLDERS:
        yield from (ROOT / folder).glob("*.ttl")


def _is_other_xml(path: Path) -> bool:
    """Whether a file is XML, and no ontology: it begins with neither the namespace of RDF nor that of OWL."""
    if path.suffix != ".xml" or not path.is_file():
        return False
    with path.open("rb") as file:
        begin = file.read(4096)
    return b"1999/02/22-rdf-syntax-ns#" not in begin and b"2002/07/owl#" not in begin
