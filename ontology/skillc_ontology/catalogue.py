"""Finds the packaged files: vocabularies, data sheets, scenes and models; and those in folders of the user's.

Such a folder is laid out like this package: data sheets stand in `robots`, `grippers`, `tools` and `fixtures`, models
beside them. Whatever else is in it are vocabularies.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parent
SHEET_FOLDERS = ("robots", "grippers", "tools", "fixtures")
VOCABULARY_FOLDERS = ("vocabulary", *SHEET_FOLDERS)
ENDINGS = (".ttl", ".owl", ".rdf", ".xml", ".nt", ".nq", ".trig", ".jsonld")
"""What the names of files end in that may be vocabularies."""
VARIABLE = "SKILLC_ONTOLOGY"
"""The environment variable with the user's folders, separated as in PATH."""


def vocabulary_files() -> tuple[tuple[str, str], ...]:
    """Return every packaged vocabulary and data sheet as (path below the ontology, Turtle text), in order of path."""
    return tuple((str(path.relative_to(ROOT)), path.read_text("utf-8")) for path in sorted(_vocabulary_paths()))


def folders() -> tuple[Path, ...]:
    """Return the folders of the user's, each once."""
    named = os.environ.get(VARIABLE, "").split(os.pathsep)
    return tuple(dict.fromkeys(Path(name) for name in named if name))


def own_files() -> tuple[tuple[str, Path], ...]:
    """Return every file in the user's folders that may be a vocabulary, by the name of its folder and the path in it.

    Hidden folders and models, which are XML too, are left out.
    """
    found = ((folder, path) for folder in folders() for path in sorted(folder.rglob("*")) if path.suffix in ENDINGS)
    below = ((folder, path, path.relative_to(folder)) for folder, path in found)
    return tuple(
        (f"{folder.resolve().name}/{inner.as_posix()}", path)
        for folder, path, inner in below
        if not any(part.startswith(".") for part in inner.parts) and not _is_model(path)
    )


def sheet_files() -> tuple[tuple[str, str], ...]:
    """Return what every world begins with: the packaged files, and the Turtle beside models of the user's."""
    own = (path for folder in folders() for name in SHEET_FOLDERS for path in sorted((folder / name).glob("*.ttl")))
    return (*vocabulary_files(), *((str(path), path.read_text("utf-8", errors="replace")) for path in own))


def scenes() -> tuple[str, ...]:
    """Return the names of the shipped scenes, with their ending."""
    return tuple(sorted(path.name for path in (ROOT / "scenes").glob("*.ttl")))


def scene(name: str) -> Path:
    """Return the path of a shipped scene, with or without `.ttl`; FileNotFoundError lists those there are."""
    file = name if name.endswith(".ttl") else f"{name}.ttl"
    if file not in scenes():
        raise FileNotFoundError(f"there is no scene {name}; there is {', '.join(scenes())}")
    return ROOT / "scenes" / file


def model(path: str) -> Path:
    """Return the path of a model that a data sheet names (`robots/ur5e.xml`); FileNotFoundError if there is none."""
    places = (ROOT, *folders())
    found = next((place / path for place in places if (place / path).is_file()), None)
    if found is None:
        raise FileNotFoundError(f"there is no model {path} in the ontology")
    return found


def own_models() -> tuple[Path, ...]:
    """Return the files in the user's folders that data sheets there may name as models."""
    places = (folder / name for folder in folders() for name in SHEET_FOLDERS)
    return tuple(path for place in places for path in sorted(place.glob("*.xml")))


def _vocabulary_paths() -> Iterator[Path]:
    for folder in VOCABULARY_FOLDERS:
        yield from (ROOT / folder).glob("*.ttl")


def _is_model(path: Path) -> bool:
    """Whether a file is a model of MuJoCo's."""
    if path.suffix != ".xml" or not path.is_file():
        return False
    with path.open("rb") as file:
        return b"<mujoco" in file.read(4096)
