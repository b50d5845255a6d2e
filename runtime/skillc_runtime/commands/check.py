"""Check skills and scenes; nothing is written.

Prints every problem with its place and its cure. Exit code 1 when there is an error.
"""

from __future__ import annotations

import sys
from pathlib import Path

import click


@click.command()
@click.argument("paths", nargs=-1, required=True, type=click.Path(path_type=Path))
@click.option("--scene", type=click.Path(path_type=Path), help="Check this scene against the library's vocabulary too.")
@click.option("--format", "form", type=click.Choice(["full", "concise", "json"]), default="full", show_default=True)
def command(paths: tuple[Path, ...], scene: Path | None, form: str) -> None:
    """Check the libraries or files at PATHS."""
    from skillc_dsl.diagnostics import Diagnostic
    from skillc_dsl.source import Source
    from skillc_runtime.commands import _diagnostics, _library, _mission, _scenes

    found: list[Diagnostic] = []
    texts: dict[str, Source] = {}
    scene = None if scene is None else _mission.scene_path(scene)
    for path in paths:
        library = _library.find(path)
        outcome = _library.compile_library(library)
        named, scenes = _scenes.individuals_of(outcome.value, library)
        if named.value:
            outcome = _library.compile_library(library, named.value)
        found += (*outcome.diagnostics, *named.diagnostics)
        texts |= _scenes.texts_of(scenes)
        texts |= _library.texts(library)
        if scene is not None:
            found += _diagnostics.of_scene(scene, outcome.value.vocabulary)
            texts |= _diagnostics.scene_text(scene)
    sys.exit(_diagnostics.show(found, texts, form))
