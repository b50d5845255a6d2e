"""Compiling a skill library for the commands, with the shipped ontology and the user's as its vocabulary."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache, lru_cache
from pathlib import Path
from typing import TypeAlias

import click

from skillc_compiler import pipeline
from skillc_compiler.library.skills import SkillLibrary, Task
from skillc_compiler.library.vocabulary import Vocabulary
from skillc_compiler.program.typed import Program
from skillc_compiler.resolve.files import read
from skillc_compiler.resolve.individuals import Individuals
from skillc_compiler.resolve.program import resolve
from skillc_compiler.vocabulary.load import load
from skillc_dsl.diagnostics import Diagnostic, Outcome, did_you_mean
from skillc_dsl.garbage import gc_disabled
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source, Span
from skillc_ontology import catalogue
from skillc_runtime.commands import _ontologies
from skillc_runtime.commands._files import SHIPPED, LibraryFiles, find, texts

Peopled: TypeAlias = Callable[[Program], Mapping[str, Individuals]]
"""The individuals in the scenes of a program's tasks, by task."""
_MOST_FILES = 2000
_MOST_VOCABULARIES = 4
__all__ = [
    "SHIPPED",
    "LibraryFiles",
    "compile_library",
    "find",
    "find_task",
    "task_named",
    "texts",
    "vocabulary",
    "vocabulary_with",
]


def compile_library(library: LibraryFiles, peopled: Peopled | None = None) -> Outcome[SkillLibrary]:
    """Compile, with the shipped ontology and the library's own as vocabulary; diagnostics show paths as from here.

    `peopled` gives the individuals that the tasks of a program may name; those of other tasks are not checked.
    """
    with gc_disabled():
        known = vocabulary_with(library.vocabularies)
        files = read(library.sources, library.shelf, library.name, _parsed)
        program = resolve(files.value, known.value, library.name, pipeline.NO_SCENES)
        individuals = peopled(program.value) if peopled else {}
        if individuals:
            program = resolve(files.value, known.value, library.name, individuals)
        checked = Outcome(program.value, pipeline.problems(files, program))
        outcome = pipeline.finish(checked, library.sources)
    return Outcome(outcome.value, tuple(_relocate(d, library) for d in (*known.diagnostics, *outcome.diagnostics)))


def vocabulary() -> Vocabulary:
    """Load the shipped ontology, and those in the folders that were named."""
    return vocabulary_with(_ontologies.sources(sorted(_ontologies.named().items()))).value


@lru_cache(_MOST_VOCABULARIES)
def vocabulary_with(own: tuple[Source, ...]) -> Outcome[Vocabulary]:
    """Load the shipped ontology with others beside it, and say what is wrong with these."""
    outcome = load(_shipped(), own)
    if outcome.diagnostics and not own:
        raise RuntimeError(f"the shipped ontology is broken: {outcome.diagnostics[0].message}")
    return outcome


@cache
def _shipped() -> tuple[Source, ...]:
    return tuple(Source(path, text) for path, text in catalogue.vocabulary_files())


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
