"""Checking a library for the commands, and a scene with it: all that a check does, when it is not remembered."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from skillc_compiler.diagnostics.suppressions import without_suppressed
from skillc_compiler.library.skills import SkillLibrary
from skillc_compiler.program.typed import Program
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.source import Source
from skillc_runtime.commands import _library, _named_texts, _telling
from skillc_runtime.commands._files import LibraryFiles

if TYPE_CHECKING:
    from skillc_runtime.commands._scenes import Populated


def check(library: LibraryFiles, scene: Path | None) -> tuple[Diagnostic, ...]:
    """Return what is wrong with a library, the scenes of its tasks, and `scene`; paths are shown as from here."""
    scenes = _Scenes(library, scene)
    outcome = _library.compile_library(library, scenes.individuals)
    program, populated = scenes.program, scenes.populated
    assert program is not None, "a library that was compiled was understood"
    around = () if populated is None else _around(outcome, program, populated, library)
    texts = _named_texts.warned(outcome, program, populated, around, library.shown)
    sources = [Source(library.shown(each.path), each.text) for each in library.sources]
    return _telling.in_order((*outcome.diagnostics, *without_suppressed((*around, *texts), sources)))


def _around(
    compiled: Outcome[SkillLibrary], program: Program, populated: Populated, library: LibraryFiles
) -> tuple[Diagnostic, ...]:
    from skillc_runtime.commands import _foresight

    return (*populated.problems, *_foresight.foreseen(compiled, program, populated, library.shown))


class _Scenes:
    """The scenes of a library's tasks and another one, once they were asked for and where there are any.

    The world model, which that takes, is heavy to import.
    """

    def __init__(self, library: LibraryFiles, scene: Path | None) -> None:
        self._library = library
        self._others = () if scene is None else (scene,)
        self.program: Program | None = None
        self.populated: Populated | None = None

    def individuals(self, program: Program) -> Mapping[str, Mapping[str, Sequence[str]]]:
        """Read the scenes and return the individuals that each task may name, with their classes."""
        self.program = program
        if not self._others and not any(task.scene for task in program.tasks):
            return {}
        from skillc_runtime.commands import _scenes

        self.populated = _scenes.populated(program, _scenes.Desk.of(self._library), self._others)
        return self.populated.individuals
