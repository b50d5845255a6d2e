"""Parses the text of one file to its syntax tree."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache

from msgspec import structs

from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic, ForeignForm, Outcome
from skillc_dsl.editions import NEWEST
from skillc_dsl.encoding import report_not_text, report_too_large, report_wrong_bytes
from skillc_dsl.parsing.automaton import MisfitError, Parser
from skillc_dsl.parsing.braces import close_braces, region_lines
from skillc_dsl.parsing.building.declarations import FileBuilder
from skillc_dsl.parsing.lexer import tokenize
from skillc_dsl.parsing.nesting import DEEPEST, drop_too_deep
from skillc_dsl.parsing.recovery import Recovery
from skillc_dsl.parsing.reserved_names import has_reserved_name, rename_reserved
from skillc_dsl.parsing.token_repairs import has_unknown_unit, repair_tokens
from skillc_dsl.parsing.tokens import Token
from skillc_dsl.source import Source, Span
from skillc_dsl.token_table import list_later_words


def build_directly(tokens: tuple[Token, ...], source: Source) -> s.File | None:
    """Return the syntax tree of a text; None if there is anything to report. The last of its tokens is the end."""
    if has_unknown_unit(tokens) or has_reserved_name(tokens, source.edition):
        return None
    builder = FileBuilder(source)
    parser = Parser(builder.make)
    try:
        for token in tokens[:-1]:
            parser.feed(token)
        file = parser.finish(tokens[-1])
    except MisfitError:
        return None
    is_clean = not builder.problems and parser.depths[-1] <= DEEPEST
    return file if is_clean and isinstance(file, s.File) else None


MOST_PROBLEMS = 200
"""The maximum number of syntax errors shown for a file."""
_MOST_KEPT = 300


@lru_cache(_MOST_KEPT)
def parse_once(source: Source) -> Outcome[s.File]:
    """Return what `parse` returns, the same for the same text: that of the last ones is kept."""
    return parse(source)


def parse(source: Source) -> Outcome[s.File]:
    """Return the syntax tree of all parts of `source` that can be parsed, with the problems in source order.

    If some bytes are not UTF-8, nothing else is reported; a file that is not text has no declarations. Of a text that
    is without problems in the newest edition only, the first problem is reported, with its edition.
    """
    refused = report_not_text(source) or report_too_large(source)
    if refused is not None:
        return Outcome(s.File(source.path, (), ()), (refused,))
    lexed = tokenize(source)
    wrong = report_wrong_bytes(source)
    file = build_directly(lexed.value, source) if not lexed.diagnostics and wrong is None else None
    if file is not None:
        return Outcome(file)
    found = parse_with_problems(source, lexed, wrong)
    return _name_edition(found, source) if list_later_words(source.edition) else found


def _name_edition(found: Outcome[s.File], source: Source) -> Outcome[s.File]:
    """Return the problems of a text of an older edition, or that it is written in the newest one."""
    if parse(source._replace(edition=NEWEST)).diagnostics:
        return found
    change = f"write `edition = {NEWEST}` in skillc.toml, or run `skillc fix --edition`"
    help_ = f"it is right from edition {NEWEST} on: {change}"
    return Outcome(found.value, (replace(found.diagnostics[0], help=help_, fix=None),))


def parse_with_problems(source: Source, lexed: Outcome[tuple[Token, ...]], wrong: Diagnostic | None) -> Outcome[s.File]:
    """Return the syntax tree of all parts that can be parsed; `wrong` is the problem with bytes that are no text."""
    repaired = repair_tokens(lexed.value, source.path)
    named = rename_reserved(repaired.value, source)
    closed = close_braces(named.value, source.path)
    reported = {problem.span.line for problem in (*repaired.diagnostics, *named.diagnostics)}
    recovery = Recovery(closed.value, source, reported)
    builder = FileBuilder(source)
    tree, too_deep = drop_too_deep(recovery.run(), source.path)
    file = builder.file(tree)
    if wrong is not None:
        return Outcome(file, (wrong,))
    unread = [*_unexplained(lexed.diagnostics, [place for _, place in recovery.foreign])]
    rewritten = [form.span if form.fix else place for form, place in recovery.foreign]
    misread = _unexplained((*_before(repaired.diagnostics, unread), *named.diagnostics), rewritten)
    unread_lines = {problem.span.line for problem in unread}
    misfits = [
        each for each in recovery.problems if isinstance(each, ForeignForm) or each.span.line not in unread_lines
    ]
    parsing = _one_kind_each(closed.diagnostics, misfits, region_lines(lexed.value))
    before = (*unread, *misread, *parsing, *too_deep)
    wrong_lines = {problem.span.line for problem in before}
    found = (*before, *(problem for problem in builder.problems if problem.span.line not in wrong_lines))
    problems = sorted(found, key=lambda problem: problem.span)
    places = (s.ErrorNode(problem.span) for problem in problems)
    return Outcome(structs.replace(file, errors=(*places, *recovery.errors)), _first(problems))


def _unexplained(problems: Iterable[Diagnostic], explained: Sequence[Span]) -> Iterator[Diagnostic]:
    """Yield the problems outside the places that a form of another language explains."""
    return (each for each in problems if not any(each.span.begins_in(place) for place in explained))


def _before(repaired: Iterable[Diagnostic], unread: Sequence[Diagnostic]) -> Iterator[Diagnostic]:
    """Yield the repairs that are not behind an unread character of their line, where tokens only seem adjacent."""
    first: dict[int, int] = {}
    for problem in unread:
        first.setdefault(problem.span.line, problem.span.column)
    return (each for each in repaired if each.span.column <= first.get(each.span.line, each.span.column))


def _one_kind_each(
    braces: Iterable[Diagnostic], misfits: Iterable[Diagnostic], regions: Iterable[range]
) -> Iterator[Diagnostic]:
    """Yield for each declaration the problems with braces or those with other tokens, whichever come first.

    A missing brace makes tokens misfit, and a line that was dropped unbalances braces.
    """
    by_line = [_by_line(problems) for problems in (braces, misfits)]
    for lines in regions:
        both = [[each for line in lines for each in problems.get(line, ())] for problems in by_line]
        yield from min((found for found in both if found), key=lambda found: found[0].span, default=[])


def _by_line(problems: Iterable[Diagnostic]) -> dict[int, list[Diagnostic]]:
    found: dict[int, list[Diagnostic]] = {}
    for each in problems:
        found.setdefault(each.span.line, []).append(each)
    return found


def _first(problems: list[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Return the problems, limited to the first ones if there are many."""
    if len(problems) <= MOST_PROBLEMS:
        return tuple(problems)
    shown, place = problems[:MOST_PROBLEMS], problems[MOST_PROBLEMS].span
    help_ = "correct those above first; if they make no sense, this is not a file of skills"
    return (
        *shown,
        Diagnostic("syntax", place, f"more than {MOST_PROBLEMS} syntax errors; the rest is not shown", help_),
    )
