"""The whole compiler on one page: the stages of compiling sources, in order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from skillc_compiler.diagnostics.fixes import keep_useful_fixes
from skillc_compiler.diagnostics.unplannable import report_unplannable
from skillc_compiler.lower.library import lower_program
from skillc_compiler.problems import find_problems, visible_diagnostics
from skillc_compiler.program.program import Program
from skillc_compiler.resolve.files import Parser, read_sources
from skillc_compiler.resolve.individuals import Individuals
from skillc_compiler.resolve.program import resolve_program
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.garbage import gc_disabled
from skillc_dsl.parsing.parser import parse
from skillc_dsl.query import Memo
from skillc_dsl.source import Source
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.types import Vocabulary

NO_SCENES: Mapping[str, Individuals] = MappingProxyType({})


def compile(
    sources: Sequence[Source],
    vocabulary: Vocabulary,
    importable: Mapping[str, Source],
    name: str,
    scenes: Mapping[str, Individuals] = NO_SCENES,
    parsed_by: Parser = parse,
) -> Outcome[SkillLibrary]:
    """Compile a library: read, resolve, check, lower; diagnostics that only follow from others are left out.

    `sources` are the files of the library called `name`, `importable` the files that it may import, by file name.
    `scenes` gives, for each task, the individuals that its goal and body may name; without it, any may be named.
    `parsed_by` is the parser, which may cache its results. The result holds every declaration without errors. The
    diagnostics are in order of file and line; those of importable files are included only if they are errors.
    """
    memo = Memo()

    def find(texts: Sequence[Source]) -> Outcome[Program]:
        return analyse(texts, vocabulary, importable, name, scenes, parsed_by, memo)

    with gc_disabled():
        found = lower_and_report(find(sources), sources)
        useful = keep_useful_fixes(found.diagnostics, sources, lambda texts: find(texts).diagnostics)
    return Outcome(found.value, useful)


def analyse(
    sources: Sequence[Source],
    vocabulary: Vocabulary,
    importable: Mapping[str, Source],
    name: str,
    scenes: Mapping[str, Individuals] = NO_SCENES,
    parsed_by: Parser = parse,
    memo: Memo | None = None,
) -> Outcome[Program]:
    """Read, resolve and check a library as `compile` does; `memo` has what the last analysis has found."""
    files = read_sources(sources, importable, name, parsed_by)
    program = resolve_program(files.value, vocabulary, name, scenes, memo, importable)
    return Outcome(program.value, find_problems(files, program, memo))


def lower_and_report(
    program: Outcome[Program], sources: Sequence[Source], memo: Memo | None = None
) -> Outcome[SkillLibrary]:
    """Lower a program, and select the diagnostics that the author of `sources` sees."""
    library = lower_program(program.value, program.diagnostics, memo)
    left_out = report_unplannable(library, program.value, program.diagnostics, memo)
    return Outcome(library, visible_diagnostics((*program.diagnostics, *left_out), sources))
