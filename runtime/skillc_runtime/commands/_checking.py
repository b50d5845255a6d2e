"""Checking a library for the commands, and a scene with it: all that a check does, when it is not remembered."""

from __future__ import annotations

from pathlib import Path

from skillc_compiler.library.skills import SkillLibrary
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_runtime.commands import _library, _telling
from skillc_runtime.commands._files import LibraryFiles


def check(library: LibraryFiles, scene: Path | None) -> tuple[Diagnostic, ...]:
    """Return what is wrong with a library, the scenes of its tasks, and `scene`; paths are shown as from here."""
    outcome = _library.compile_library(library)
    if scene is None and not any(task.scene for task in outcome.value.tasks.values()):
        return _telling.in_order(outcome.diagnostics)
    return _telling.in_order(_with_scenes(library, outcome, scene))


def _with_scenes(library: LibraryFiles, outcome: Outcome[SkillLibrary], scene: Path | None) -> tuple[Diagnostic, ...]:
    """Check what the library says of its scenes too; the world model, which that takes, is heavy to import."""
    from skillc_runtime.commands import _diagnostics, _scenes

    named, _ = _scenes.individuals_of(outcome.value, library)
    if named.value:
        outcome = _library.compile_library(library, named.value)
    of_scene = _diagnostics.of_scene(scene, outcome.value.vocabulary) if scene else ()
    foreseen = _scenes.foreseen(outcome, library, scene)
    return (*outcome.diagnostics, *named.diagnostics, *of_scene, *foreseen)
