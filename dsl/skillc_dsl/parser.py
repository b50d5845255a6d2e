"""From the text of one file to its syntax tree."""

from __future__ import annotations

from skillc_dsl import syntax as s
from skillc_dsl.braces import close_braces
from skillc_dsl.building.declarations import Declarations
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.encoding import not_text, wrong_bytes
from skillc_dsl.lexing import tokens_of
from skillc_dsl.recovery import Recovery
from skillc_dsl.source import Source
from skillc_dsl.spelling import mend


def parse(source: Source) -> Outcome[s.File]:
    """Return what could be understood of `source`, with the problems of the rest in the order of the text.

    Bytes that are not UTF-8 are the only problem told of a file that has some; what is no text has no declarations.
    """
    foreign = not_text(source)
    if foreign is not None:
        return Outcome(s.File(source.path, (), ()), (foreign,))
    lexed = tokens_of(source)
    mended = mend(lexed.value, source.path)
    closed = close_braces(mended.value, source.path)
    told = {problem.span.line for problem in mended.diagnostics}
    recovery = Recovery(closed.value, source.path, told)
    builder = Declarations(source)
    file = builder.file(recovery.run())
    wrong = wrong_bytes(source)
    if wrong is not None:
        return Outcome(file, (wrong,))
    unread = {problem.span.line for problem in lexed.diagnostics}
    misfits = (problem for problem in recovery.problems if problem.span.line not in unread)
    problems = (*lexed.diagnostics, *mended.diagnostics, *closed.diagnostics, *misfits, *builder.problems)
    return Outcome(file, tuple(sorted(problems, key=lambda problem: problem.span)))
