"""Compiling a skill library for the commands, with the shipped ontology as its vocabulary."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache, lru_cache
from pathlib import Path

import click

from skillc_compiler import pipeline
from skillc_compiler.library.skills import SkillLibrary, Task
from skillc_compiler.library.vocabulary import Vocabulary
from skillc_compiler.vocabulary.load import load
from skillc_dsl.diagnostics import Diagnostic, Outcome, did_you_mean
from skillc_dsl.parser import parse
from skillc_dsl.source import Source, Span
from skillc_ontology import catalogue
from skillc_runtime.commands._files import SHIPPED, LibraryFiles, find, texts

_MOST_FILES = 2000
__all__ = ["SHIPPED", "LibraryFiles", "compile_library", "find", "find_task", "task_named", "texts", "vocabulary"]


def compile_library(
    library: LibraryFiles, scenes: Mapping[str, Mapping[str, Sequence[str]]] | None = None
) -> Outcome[SkillLibrary]:
    """Compile, with the shipped ontology as vocabulary; diagnostics show paths as from here.

    `scenes` are the individuals that each task may name, with their classes; those of other tasks are not checked.
    """
    outcome = pipeline.compile(library.sources, vocabulary(), library.shelf, library.name, scenes or {}, _parsed)
    return Outcome(outcome.value, tuple(_relocate(d, library) for d in outcome.diagnostics))


@cache
def vocabulary() -> Vocabulary:
    """Load the shipped ontology."""
    outcome = load([Source(path, text) for path, text in catalogue.vocabulary_files()])
    if outcome.diagnostics:
        raise RuntimeError(f"the shipped ontology is broken: {outcome.diagnostics[0].message}")
    return outcome.value


def find_task(reference: str) -> tuple[LibraryFiles, str]:
    """Split `LIBRARY:NAME`, or take a bare name as a task of the shipped wiping library."""
    path, colon, name = reference.rpartition(":")
    return find(Path(path) if colon else SHIPPED / "wiping"), name


def task_named(library: SkillLibrary, name: str) -> Task:
    """Return a task; UsageError lists those that exist."""
    if name not in library.tasks:
        hint = did_you_mean(name, library.tasks) or "it has none"
        elsewhere = "a task of another library is written LIBRARY:NAME"
        raise click.UsageError(f"there is no task `{name}` in {library.name}: {hint}; {elsewhere}")
    return library.tasks[name]


_parsed = lru_cache(_MOST_FILES)(parse)


def _relocate(diagnostic: Diagnostic, library: LibraryFiles) -> Diagnostic:
    def moved(span: Span) -> Span:
        return replace(span, path=library.shown(span.path))

    return replace(
        diagnostic,
        span=moved(diagnostic.span),
        labels=tuple(replace(label, span=moved(label.span)) for label in diagnostic.labels),
        fix=replace(diagnostic.fix, span=moved(diagnostic.fix.span)) if diagnostic.fix else None,
    )
