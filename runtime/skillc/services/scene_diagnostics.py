"""The problems of a scene as diagnostics."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from skillc_compiler.turtle.problems import Edit, Place, Problem
from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.source import Source, Span
from skillc_ontology import catalogue
from skillc_runtime.world.documents import Document, SceneError


def convert_problems(problems: Iterable[Problem]) -> list[Diagnostic]:
    """Return the problems of a scene as diagnostics; those of the shipped ontology are shown below it."""
    return [
        Diagnostic(
            name=problem.name,
            span=span_of(problem.place),
            message=problem.message,
            help=problem.help,
            severity=problem.severity,
            labels=tuple(Label(span_of(note.place), note.message) for note in problem.notes),
            fix=None if problem.edit is None else _fix(problem.edit),
        )
        for problem in problems
    ]


def _fix(edit: Edit) -> Fix:
    return Fix(span_of(edit.place), edit.text, edit.message, safe=False)


def span_of(place: Place) -> Span:
    """Return a place in a Turtle file as a span; a file of the shipped ontology is shown below it."""
    shipped, here = catalogue.ROOT / place.path, Path.cwd()
    if Path(place.path).exists() or not shipped.is_file():
        return Span(place.path, place.line, place.column, place.end_line, place.end_column)
    shown = shipped.relative_to(here) if shipped.is_relative_to(here) else shipped
    return Span(str(shown), place.line, place.column, place.end_line, place.end_column)


def scene_text(scene: Path) -> dict[str, Source]:
    """Return the scene's text by its path, for excerpts; nothing when it cannot be read."""
    try:
        return {str(scene): Source(str(scene), Document.read(scene).text)}
    except SceneError:
        return {}
