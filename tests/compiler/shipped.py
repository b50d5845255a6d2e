"""The shipped vocabulary and shelf, read once."""

from functools import cache
from importlib.resources import files
from pathlib import Path

from skillc_dsl.source import Source
from skillc_ontology.catalogue import vocabulary_files
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.types import Vocabulary

SKILLS = Path(str(files("skillc_skills")))


@cache
def vocabulary() -> Vocabulary:
    """Return the shipped vocabulary."""
    outcome = load([Source(path, text) for path, text in vocabulary_files()])
    assert outcome.diagnostics == ()
    return outcome.value


@cache
def shelf() -> dict[str, Source]:
    """Return the standard library's files by name."""
    return {
        path.name: Source(f"std/{path.name}", path.read_text()) for path in sorted((SKILLS / "std").glob("*.skill"))
    }


def library(name: str) -> list[Source]:
    """Return the files of a shipped library."""
    return [Source(path.name, path.read_text()) for path in sorted((SKILLS / name).glob("*.skill"))]
