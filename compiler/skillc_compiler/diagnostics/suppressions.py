"""Suppression of warnings by a comment above the line of the warning: `# allow NAME: reason`."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence

import msgspec

from skillc_compiler.manual import load_page, page_names
from skillc_compiler.program.spelling import suggest_fix
from skillc_dsl import syntax as s
from skillc_dsl.comments import Comment, find_comments
from skillc_dsl.diagnostics import Diagnostic, Fix
from skillc_dsl.source import Source, Span
from skillc_dsl.spelling import did_you_mean

_SUPPRESSION = re.compile(r"#\s*allow\s+(?P<name>[\w-]+)\s*(?P<colon>:?)\s*(?P<reason>.*)")


class Suppression(msgspec.Struct, frozen=True):
    """A comment that suppresses the warnings called `name` on `line`; `reason` may be empty."""

    name: s.Name
    reason: str
    line: int
    comment: Span


def apply_suppressions(problems: Sequence[Diagnostic], sources: Iterable[Source]) -> tuple[Diagnostic, ...]:
    """Return the problems without suppressed warnings, and with the problems of the suppressions themselves.

    Unused suppressions are only reported if there is no error, because errors leave parts unchecked.
    """
    found = tuple(suppression for source in sources for suppression in find_suppressions(source))
    if not found:
        return tuple(problems)
    allowed = {(each.comment.path, each.line, each.name.text) for each in found}
    warnings = {problem for problem in problems if problem.severity == "warning"}
    left = tuple(problem for problem in problems if problem not in warnings or _place(problem) not in allowed)
    errors = tuple(problem for problem in problems if problem not in warnings)
    used = {_place(problem) for problem in warnings}
    return (*left, *(flaw for each in found for flaw in _problems(each, used, errors)))


def without_suppressed(problems: Iterable[Diagnostic], sources: Iterable[Source]) -> tuple[Diagnostic, ...]:
    """Return the problems without suppressed warnings, for problems that are found after compiling a library."""
    allowed = {
        (each.comment.path, each.line, each.name.text) for source in sources for each in find_suppressions(source)
    }
    return tuple(each for each in problems if each.severity != "warning" or _place(each) not in allowed)


def find_suppressions(source: Source) -> Iterator[Suppression]:
    """Yield the suppressions in a text; each is for the first line below that is not a comment."""
    if "allow" not in source.text:
        return
    every = find_comments(source)
    below = _lines_below({comment.span.line for comment in every if comment.alone})
    for comment in every:
        match = _SUPPRESSION.fullmatch(comment.written)
        if match is None or not comment.alone or not _is_meant(match):
            continue
        line = below[comment.span.line]
        yield Suppression(_name(comment, match), match["reason"].strip(), line, comment.span)


def _lines_below(lines: Collection[int]) -> dict[int, int]:
    """Return for each line the first one below it that is not one of them."""
    below: dict[int, int] = {}
    for line in sorted(lines, reverse=True):
        below[line] = below.get(line + 1, line + 1)
    return below


def _is_meant(match: re.Match[str]) -> bool:
    """Whether this is a suppression, not prose that begins with the word."""
    return bool(match["colon"]) or "-" in match["name"] or match["name"] in page_names()


def _name(comment: Comment, match: re.Match[str]) -> s.Name:
    span = comment.span
    start, end = span.column + match.start("name"), span.column + match.end("name")
    return s.Name(match["name"], Span(span.path, span.line, start, span.line, end))


def _problems(each: Suppression, used: set[tuple[str, int, str]], errors: Sequence[Diagnostic]) -> Iterator[Diagnostic]:
    name = each.name.text
    if name not in page_names():
        yield Diagnostic(
            "unknown-allow",
            each.name.span,
            f"there is no warning called `{name}`",
            did_you_mean(name, page_names()) or "`skillc explain` lists them all",
            "warning",
            fix=suggest_fix(each.name, page_names()),
        )
    elif any(_place(error) == (each.comment.path, each.line, name) for error in errors):
        yield _unused(each, f"`{name}` is an error here, which cannot be allowed", "fix it, and delete this comment")
    elif not errors and not _is_found_later(name) and (each.comment.path, each.line, name) not in used:
        yield _unused(each, f"there is no `{name}` to allow on line {each.line}", "delete this comment")
    elif not each.reason:
        help_ = f"write `# allow {name}: ` and the reason"
        yield Diagnostic(
            "allow-without-reason", each.comment, "this gives no reason why it is allowed", help_, "warning"
        )


def _is_found_later(name: str) -> bool:
    """Whether the compiler cannot decide if there is such a warning, because `skillc check` reports it later."""
    return name == "unknown-value" or load_page(name).found_by == "check"


def _unused(each: Suppression, message: str, help_: str) -> Diagnostic:
    span = each.comment
    whole = Span(span.path, span.line, 1, span.line + 1, 1)
    fix = Fix(whole, "", "delete the comment")
    return Diagnostic("unused-allow", each.name.span, message, help_, "warning", fix=fix)


def _place(problem: Diagnostic) -> tuple[str, int, str]:
    return problem.span.path, problem.span.line, problem.name
