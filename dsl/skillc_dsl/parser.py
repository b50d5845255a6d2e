"""From the text of one file to its syntax tree."""

from __future__ import annotations

from skillc_dsl import syntax as s
from skillc_dsl.braces import close_braces
from skillc_dsl.building.declarations import Declarations
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.encoding import not_text, too_large, wrong_bytes
from skillc_dsl.lexing import tokens_of
from skillc_dsl.nesting import without_too_deep
from skillc_dsl.recovery import Recovery
from skillc_dsl.source import Source
from skillc_dsl.spelling import mend

MOST_PROBLEMS = 200
"""So many syntax errors of one file are shown."""


def parse(source: Source) -> Outcome[s.File]:
    """Return what could be understood of `source`, with the problems of the rest in the order of the text.

    Bytes that are not UTF-8 are the only problem told of a file that has some; what is no text has no declarations.
    """
    refused = not_text(source) or too_large(source)
    if refused is not None:
        return Outcome(s.File(source.path, (), ()), (refused,))
    lexed = tokens_of(source)
    mended = mend(lexed.value, source.path)
    closed = close_braces(mended.value, source.path)
    told = {problem.span.line for problem in mended.diagnostics}
    recovery = Recovery(closed.value, source.path, told)
    builder = Declarations(source)
    tree, too_deep = without_too_deep(recovery.run(), source.path)
    file = builder.file(tree)
    wrong = wrong_bytes(source)
    if wrong is not None:
        return Outcome(file, (wrong,))
    unread = {problem.span.line for problem in lexed.diagnostics}
    misfits = (problem for problem in recovery.problems if problem.span.line not in unread)
    problems = (*lexed.diagnostics, *mended.diagnostics, *closed.diagnostics, *misfits, *too_deep, *builder.problems)
    return Outcome(file, _first(sorted(problems, key=lambda problem: problem.span)))


def _first(problems: list[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return the problems, of very many only the first ones."""
    if len(problems) <= MOST_PROBLEMS:
        return tuple(problems)
    shown, place = problems[:MOST_PROBLEMS], problems[MOST_PROBLEMS].span
    help_ = "correct those above first; if they make no sense, this is no file of skills"
    return (
        *shown,
        Diagnostic("syntax", place, f"more than {MOST_PROBLEMS} syntax errors; the rest is not shown", help_),
    )
