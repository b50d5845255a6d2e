"""Gives the diagnostics of a scene displayable paths."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from skillc_dsl.diagnostics import Diagnostic, Fix, Label
from skillc_dsl.source import Source, Span
from skillc_ontology import catalogue
from skillc_runtime.scene.documents import Document, SceneError


def with_shown_paths(problems: Iterable[Diagnostic]) -> list[Diagnostic]:
    """Return the diagnostics of a scene with displayable paths."""
    return [
        replace(
            each, span=with_shown_path(each.span), labels=tuple(map(_shown_label, each.labels)), fix=_shown_fix(each)
        )
        for each in problems
    ]


def with_shown_path(span: Span) -> Span:
    """Return a span in a Turtle file; a file of the shipped ontology gets its path on this machine."""
    shipped, here = catalogue.ROOT / span.path, Path.cwd()
    if Path(span.path).exists() or not shipped.is_file():
        return span
    return span._replace(path=str(shipped.relative_to(here) if shipped.is_relative_to(here) else shipped))


def _shown_label(label: Label) -> Label:
    return label._replace(span=with_shown_path(label.span))


def _shown_fix(problem: Diagnostic) -> Fix | None:
    return problem.fix and problem.fix._replace(span=with_shown_path(problem.fix.span))


def read_scene_text(scene: Path) -> dict[str, Source]:
    """Return the scene's text by its path, for excerpts; empty if it cannot be read."""
    try:
        return {str(scene): Source(str(scene), Document.read(scene).text)}
    except SceneError:
        return {}
