"""Compiles skill libraries, with the shipped ontology and the user's as vocabulary."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache, lru_cache, partial
from threading import get_ident
from typing import TypeAlias

from skillc.services.library.files import LibraryFiles
from skillc.services.library.ontology_imports import follow_imports
from skillc.services.library.source_files import read_vocabularies, user_vocabularies
from skillc_compiler import pipeline
from skillc_compiler.diagnostics.fixes import keep_useful_fixes
from skillc_compiler.problems import find_problems
from skillc_compiler.program.program import Program
from skillc_compiler.resolve.files import read_sources
from skillc_compiler.resolve.individuals import Individuals
from skillc_compiler.resolve.program import resolve_program
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.garbage import gc_disabled
from skillc_dsl.parsing.parser import parse_once
from skillc_dsl.parsing.reparse import parse_with
from skillc_dsl.query import Memo
from skillc_dsl.source import Source, Span
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_rdf.vocabulary.conflicts import judge_conflicts
from skillc_rdf.vocabulary.load import load
from skillc_rdf.vocabulary.types import Vocabulary

IndividualsByTask: TypeAlias = Callable[[Program], Mapping[str, Individuals]]
"""Returns the individuals in the scenes of a program's tasks, by task."""
_MOST_VOCABULARIES = 4
_MOST_MEMOS = 4


def compile_library(
    library: LibraryFiles,
    find_individuals: IndividualsByTask | None = None,
    memo: Memo | None = None,
) -> Outcome[SkillLibrary]:
    """Compile, with the shipped and the library's own ontology as vocabulary; diagnostics have displayable paths.

    `find_individuals` returns the individuals that each task may name; the names in other tasks are not checked.
    `memo` has what is known of the library; without it, what was found here of the last one with this name is used.
    """
    parsed_by = partial(parse_with, memo) if memo else parse_once
    memo = memo or _memo_of(get_ident(), library.name)
    with gc_disabled():
        known = load_vocabulary_with(library.vocabularies)
        files = read_sources(library.sources, library.importable, library.name, parsed_by, library.namespaces)
        resolve = partial(resolve_program, base=known.value, name=library.name, importable=library.importable)
        program = resolve(files.value, scenes=pipeline.NO_SCENES, memo=memo)
        individuals = find_individuals(program.value) if find_individuals else {}
        if individuals:
            program = resolve(files.value, scenes=individuals, memo=memo)
        checked = Outcome(program.value, find_problems(files, program, memo))
        outcome = pipeline.lower_and_report(checked, library.sources, memo)

        def check(texts: Sequence[Source]) -> tuple[Diagnostic, ...]:
            others = read_sources(texts, library.importable, library.name, parsed_by, library.namespaces)
            found = resolve(others.value, scenes=individuals, memo=memo)
            return find_problems(others, found, memo)

        conflicts = judge_conflicts(known.diagnostics, program.value.vocabulary, program.value.terms)
        useful = keep_useful_fixes(outcome.diagnostics, library.sources, check)
    return Outcome(outcome.value, tuple(library.with_display_paths(each) for each in (*conflicts, *useful)))


def load_vocabulary() -> Vocabulary:
    """Load the shipped ontology and those in the user's ontology folders."""
    return load_vocabulary_with(read_vocabularies(sorted(follow_imports(user_vocabularies(), {}).items()))).value


@lru_cache(_MOST_VOCABULARIES)
def load_vocabulary_with(own: tuple[Source, ...]) -> Outcome[Vocabulary]:
    """Load the shipped ontology together with others, with the diagnostics of the others."""
    outcome = load(shipped_sources(), own)
    if outcome.diagnostics and not own:
        raise RuntimeError(f"the shipped ontology is broken: {outcome.diagnostics[0].message}")
    return outcome


def find_named_terms(library: LibraryFiles) -> Mapping[str, Span]:
    """Return the terms of vocabularies that a library names, with a place of each; paths are displayable."""
    known = load_vocabulary_with(library.vocabularies).value
    files = read_sources(library.sources, library.importable, library.name, parse_once, library.namespaces)
    resolved = resolve_program(files.value, known, library.name, pipeline.NO_SCENES, importable=library.importable)
    return {iri: span._replace(path=library.display_path(span.path)) for iri, span in resolved.value.terms.items()}


@lru_cache(_MOST_MEMOS)
def _memo_of(_thread: int, _library: str) -> Memo:
    """Return what a thread has found of the last libraries with a name, which say much the same, wherever they are."""
    return Memo()


@cache
def shipped_sources() -> tuple[Source, ...]:
    """Return the texts of the shipped ontology."""
    return tuple(Source(path, text) for path, text in catalogue.vocabulary_files())
