"""Finds the packaged files: vocabularies, data sheets, scenes and models."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.resources import files
from pathlib import Path

ROOT = Path(str(files("skillc_ontology")))
VOCABULARY_FOLDERS = ("vocabulary", "robots", "grippers", "tools")


def vocabulary_files() -> tuple[tuple[str, str], ...]:
    """Return every vocabulary and data sheet as (path below the ontology, Turtle text), in order of path."""
    return tuple((str(path.relative_to(ROOT)), path.read_text("utf-8")) for path in sorted(_vocabulary_paths()))


def scenes() -> tuple[str, ...]:
    """Return the names of the shipped scenes, with their ending."""
    return tuple(sorted(path.name for path in (ROOT / "scenes").glob("*.ttl")))


def scene(name: str) -> Path:
    """Return the path of a shipped scene, with or without `.ttl`; FileNotFoundError lists those there are."""
    path = ROOT / "scenes" / (name if name.endswith(".ttl") else f"{name}.ttl")
    if not path.is_file():
        raise FileNotFoundError(f"there is no scene {name}; there is {', '.join(scenes())}")
    return path


def model(path: str) -> Path:
    """Return the path of a model that a data sheet names (`robots/ur5e.xml`); FileNotFoundError if there is none."""
    found = ROOT / path
    if not found.is_file():
        raise FileNotFoundError(f"there is no model {path} in the ontology")
    return found


def _vocabulary_paths() -> Iterator[Path]:
    for folder in VOCABULARY_FOLDERS:
        yield from (ROOT / folder).glob("*.ttl")
