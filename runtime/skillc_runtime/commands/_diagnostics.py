"""Showing diagnostics on the terminal and turning a scene's problems into them."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TextIO

import click

from skillc_compiler.library.vocabulary import Vocabulary
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.rendering.concise import render as concise
from skillc_dsl.rendering.full import render as full
from skillc_dsl.rendering.json import render as as_json
from skillc_dsl.source import Source, Span
from skillc_runtime.world.documents import Document, SceneError, SceneProblem
from skillc_runtime.world.scene import load_scene


def show(diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source], form: str) -> int:
    """Print the diagnostics in a form, with a summary on stderr, and return the exit code: 1 with errors."""
    unique = sorted(set(diagnostics), key=lambda d: (d.span, d.name))
    if form == "json":
        click.echo(as_json(unique, texts))
    elif form == "concise":
        click.echo(concise(unique, texts), nl=False)
    else:
        click.echo(full(unique, texts, colour=_colour(sys.stdout)), nl=False)
    errors = sum(d.severity == "error" for d in unique)
    if form != "json":
        click.echo(_summary(errors, len(unique) - errors), err=True)
    return 1 if errors else 0


def tell(diagnostics: Sequence[Diagnostic], texts: Mapping[str, Source]) -> None:
    """Print diagnostics in full on stderr, for commands whose output is something else."""
    click.echo(full(diagnostics, texts, colour=_colour(sys.stderr)), err=True, nl=False)


def of_scene(scene: Path, vocabulary: Vocabulary) -> list[Diagnostic]:
    """Return what is wrong with a scene, as diagnostics in its file."""
    try:
        load_scene(scene, vocabulary)
    except SceneError as error:
        return of_problems(error.problems)
    return []


def of_problems(problems: Iterable[SceneProblem]) -> list[Diagnostic]:
    """Return the problems of a scene as diagnostics."""
    return [
        Diagnostic(p.name, Span(p.path, p.line, p.column, p.line, p.column + 1), p.message, p.help) for p in problems
    ]


def scene_text(scene: Path) -> dict[str, Source]:
    """Return the scene's text by its path, for excerpts; nothing when it cannot be read."""
    try:
        return {str(scene): Source(str(scene), Document.read(scene).text)}
    except SceneError:
        return {}


def _colour(stream: TextIO) -> bool:
    return stream.isatty() and "NO_COLOR" not in os.environ


def _summary(errors: int, warnings: int) -> str:
    if not errors and not warnings:
        return "no problems"
    counts = [(errors, "error"), (warnings, "warning")]
    return ", ".join(f"{count} {word}{'s' * (count != 1)}" for count, word in counts if count)
