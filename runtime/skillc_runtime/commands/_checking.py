"""Checking a library for the commands, and a scene with it: all that a check does, when it is not remembered."""

from __future__ import annotations

from pathlib import Path

from skillc_dsl.diagnostics import Diagnostic
from skillc_runtime.commands import _diagnostics, _library, _scenes, _telling
from skillc_runtime.commands._files import LibraryFiles


def check(library: LibraryFiles, scene: Path | None) -> tuple[Diagnostic, ...]:
    """Return what is wrong with a library, the scenes of its tasks, and `scene`; paths are shown as from here."""
    outcome = _library.compile_library(library)
    named, _ = _scenes.individuals_of(outcome.value, library)
    if named.value:
        outcome = _library.compile_library(library, named.value)
    of_scene = _diagnostics.of_scene(scene, outcome.value.vocabulary) if scene else ()
    foreseen = _scenes.foreseen(outcome, library, scene)
    return _telling.in_order((*outcome.diagnostics, *named.diagnostics, *of_scene, *foreseen))
