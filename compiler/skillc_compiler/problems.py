"""Finds the problems of a resolved program: all errors, and nothing that may only follow from them."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from skillc_compiler.checks import run_checks
from skillc_compiler.diagnostics.prefixes import with_prefix
from skillc_compiler.diagnostics.suppressions import apply_suppressions
from skillc_compiler.diagnostics.unknown_names import report_unknown_names
from skillc_compiler.program.marks import Marks, Need
from skillc_compiler.program.program import ParsedFile, Program
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.query import Memo
from skillc_dsl.source import Source


def find_problems(
    files: Outcome[tuple[ParsedFile, ...]],
    program: Outcome[Program],
    memo: Memo | None = None,
    paths: Collection[str] | None = None,
) -> tuple[Diagnostic, ...]:
    """Check a program; return the diagnostics of all errors, and nothing that may only follow from them.

    With `paths`, only the declarations in these files are checked.
    """
    syntax = tuple(with_prefix(problem, program.value) for problem in files.diagnostics)
    marks = Marks(program.value, ())
    unknown = (problem for problem in report_unknown_names(program.value) if marks.allow(Need.TEXT, problem))
    known = (*syntax, *unknown)
    allowed = (problem for problem in program.diagnostics if marks.allow(Need.TEXT, problem))
    lines = {(each.span.path, each.span.line) for each in known}
    resolving = [
        problem
        for problem in allowed
        if (problem.span.path, problem.span.line) not in lines and not marks.blames_broken(problem)
    ]
    return (*known, *run_checks(program.value, known, resolving, memo, paths))


def visible_diagnostics(problems: Sequence[Diagnostic], sources: Sequence[Source]) -> tuple[Diagnostic, ...]:
    """Return the diagnostics that the author of `sources` sees, in order of place; of other files only errors.

    Suppressed warnings are left out.
    """
    own = {source.path for source in sources}
    chosen = [problem for problem in problems if problem.severity == "error" or problem.span.path in own]
    return tuple(sorted(dict.fromkeys(apply_suppressions(chosen, sources)), key=_order))


def _order(problem: Diagnostic) -> tuple[object, ...]:
    """Return by what problems are put in order: what differs between two at one place that say the same, too."""
    return problem.span, problem.name, problem.message, problem.help, problem.labels
