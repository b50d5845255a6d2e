"""A case: one feature of the language in a small file, with what each artifact is expected to make of it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path

from skillc_compiler.pipeline import compile
from skillc_dsl.source import Source
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.types import Vocabulary
from skillc_runtime.scene.documents import Document
from skillc_runtime.scene.load import load_documents
from skillc_runtime.world.state.world_state import WorldState

HERE = Path(__file__).parent
MARK = "#="


@dataclass(frozen=True)
class Case:
    """A case file: its first comment names the feature, lines that begin with `#=` what becomes of it."""

    path: Path

    @property
    def name(self) -> str:
        """What the file is called."""
        return self.path.stem

    @property
    def text(self) -> str:
        """The whole file."""
        return self.path.read_text()

    @property
    def feature(self) -> str:
        """The feature in words."""
        return self.text.splitlines()[0].removeprefix("#").strip()

    @property
    def expected(self) -> dict[str, str]:
        """What is expected, by the word of the artifact."""
        marked = (line.removeprefix(MARK) for line in self.text.splitlines() if line.startswith(MARK))
        return dict(line.strip().split(None, 1) for line in marked)

    def library(self) -> tuple[SkillLibrary, tuple[str, ...]]:
        """Compile the case; return the names of the errors beside the library."""
        shelf = {"acts.skill": Source("std/acts.skill", (HERE / "acts.skill").read_text())}
        outcome = compile([Source(self.path.name, self.text)], vocabulary(), shelf, self.name)
        errors = tuple(each.name for each in outcome.diagnostics if each.severity == "error")
        return outcome.value, errors


def cases() -> list[Case]:
    """Return all cases, in order of their names."""
    return [Case(path) for path in sorted((HERE / "cases").glob("*.skill"))]


@cache
def vocabulary() -> Vocabulary:
    """Return the vocabulary of the cases."""
    return load([Source("lab.ttl", (HERE / "lab.ttl").read_text())]).value


def scene(library: SkillLibrary) -> WorldState:
    """Return the world of the cases in the words of a library."""
    return load_documents([Document("scene.ttl", (HERE / "scene.ttl").read_text())], library.vocabulary)
