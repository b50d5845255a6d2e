"""The whole compiler on one page: the stages of compiling sources, in order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

from skillc_compiler.checks import CheckMemo, run_checks
from skillc_compiler.diagnostics.prefixes import with_prefix
from skillc_compiler.diagnostics.suppressions import apply_suppressions
from skillc_compiler.diagnostics.unknown_names import report_unknown_names
from skillc_compiler.diagnostics.unplannable import report_unplannable
from skillc_compiler.lower.library import lower_program
from skillc_compiler.program.marks import Marks, Need
from skillc_compiler.program.typed import ParsedFile, Program
from skillc_compiler.resolve.files import Parser, read_sources
from skillc_compiler.resolve.individuals import Individuals
from skillc_compiler.resolve.memo import ResolveMemo
from skillc_compiler.resolve.program import resolve_program
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.garbage import gc_disabled
from skillc_dsl.parsing.parser import parse
from skillc_dsl.source import Source
from skillc_model.skills import SkillLibrary
from skillc_rdf.vocabulary.types import Vocabulary

NO_SCENES: Mapping[str, Individuals] = MappingProxyType({})


@dataclass
class AnalysisMemo:
    """What the last analysis of a library has found, by declaration; the next one reuses what has not changed.

    An analysis with it has the same result as one without it, whatever was analysed before.
    """

    resolve: ResolveMemo = field(default_factory=ResolveMemo)
    checks: CheckMemo = field(default_factory=CheckMemo)


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
    with gc_disabled():
        return lower_and_report(analyse(sources, vocabulary, importable, name, scenes, parsed_by), sources)


def analyse(
    sources: Sequence[Source],
    vocabulary: Vocabulary,
    importable: Mapping[str, Source],
    name: str,
    scenes: Mapping[str, Individuals] = NO_SCENES,
    parsed_by: Parser = parse,
) -> Outcome[Program]:
    """Read, resolve and check a library as `compile` does."""
    files = read_sources(sources, importable, name, parsed_by)
    program = resolve_program(files.value, vocabulary, name, scenes)
    return Outcome(program.value, find_problems(files, program))


def find_problems(
    files: Outcome[tuple[ParsedFile, ...]], program: Outcome[Program], memo: AnalysisMemo | None = None
) -> tuple[Diagnostic, ...]:
    """Check a program; return the diagnostics of all errors, and nothing that may only follow from them."""
    syntax = tuple(with_prefix(problem, program.value) for problem in files.diagnostics)
    marks = Marks(program.value, ())
    unknown = (problem for problem in report_unknown_names(program.value) if marks.allow(Need.TEXT, problem))
    known = (*syntax, *unknown)
    allowed = (problem for problem in program.diagnostics if marks.allow(Need.TEXT, problem))
    resolving = [problem for problem in allowed if not marks.blames_broken(problem)]
    return (*known, *run_checks(program.value, known, resolving, memo.checks if memo else None))


def lower_and_report(program: Outcome[Program], sources: Sequence[Source]) -> Outcome[SkillLibrary]:
    """Lower a program, and select the diagnostics that the author of `sources` sees."""
    library = lower_program(program.value, program.diagnostics)
    left_out = report_unplannable(library, program.value, program.diagnostics)
    return Outcome(library, visible_diagnostics((*program.diagnostics, *left_out), sources))


def visible_diagnostics(problems: Sequence[Diagnostic], sources: Sequence[Source]) -> tuple[Diagnostic, ...]:
    """Return the diagnostics that the author of `sources` sees, in order of place; of other files only errors.

    Suppressed warnings are left out.
    """
    own = {source.path for source in sources}
    chosen = [problem for problem in problems if problem.severity == "error" or problem.span.path in own]
    return tuple(
        sorted(
            set(apply_suppressions(chosen, sources)), key=lambda problem: (problem.span, problem.name, problem.message)
        )
    )
