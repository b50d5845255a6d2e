"""Warnings that an author has decided to live with: `# allow NAME: reason` above the line they are told of."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from skillc_compiler.manual import load_page, page_names
from skillc_compiler.resolve.spelling import suggest_fix
from skillc_dsl import syntax as s
from skillc_dsl.comments import Comment, find_comments
from skillc_dsl.diagnostics import Diagnostic, Fix, did_you_mean
from skillc_dsl.source import Source, Span

_SUPPRESSION = re.compile(r"#\s*allow\s+(?P<name>[\w-]+)\s*(?P<colon>:?)\s*(?P<reason>.*)")


@dataclass(frozen=True, slots=True)
class Suppression:
    """A comment that allows the warnings called `name` on `line`; `reason` may be missing."""

    name: s.Name
    reason: str
    line: int
    comment: Span


def apply_suppressions(problems: Sequence[Diagnostic], sources: Iterable[Source]) -> tuple[Diagnostic, ...]:
    """Return the problems without the warnings that `sources` allow, and with what is wrong with the suppressions.

    Which of them are unused is told only where there is no error, because errors leave things unchecked.
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
    """Leave out the warnings that `sources` allow, of problems that are found when a library has been compiled."""
    allowed = {
        (each.comment.path, each.line, each.name.text) for source in sources for each in find_suppressions(source)
    }
    return tuple(each for each in problems if each.severity != "warning" or _place(each) not in allowed)


def find_suppressions(source: Source) -> Iterator[Suppression]:
    """Yield the suppressions in a text; each is for the first line below that is no comment."""
    if "allow" not in source.text:
        return
    every = find_comments(source)
    alone = {comment.span.line for comment in every if comment.alone}
    for comment in every:
        match = _SUPPRESSION.fullmatch(comment.written)
        if match is None or not comment.alone or not _is_meant(match):
            continue
        line = comment.span.line + 1
        while line in alone:
            line += 1
        yield Suppression(_name(comment, match), match["reason"].strip(), line, comment.span)


def _is_meant(match: re.Match[str]) -> bool:
    """Whether this is a suppression and not prose that begins with the word."""
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
        yield _unused(each, f"`{name}` is an error here, which cannot be allowed", "cure it, and delete this comment")
    elif not errors and not _is_found_later(name) and (each.comment.path, each.line, name) not in used:
        yield _unused(each, f"there is no `{name}` to be allowed on line {each.line}", "delete this comment")
    elif not each.reason:
        help_ = f"write `# allow {name}: ` and why"
        yield Diagnostic("allow-without-reason", each.comment, "this says not why it is allowed", help_, "warning")


def _is_found_later(name: str) -> bool:
    """Whether the compiler cannot tell if there is such a warning, because `skillc check` looks for it afterwards."""
    return name == "unknown-value" or load_page(name).found_by == "check"


def _unused(each: Suppression, message: str, help_: str) -> Diagnostic:
    span = each.comment
    whole = Span(span.path, span.line, 1, span.line + 1, 1)
    fix = Fix(whole, "", "delete the comment")
    return Diagnostic("unused-allow", each.name.span, message, help_, "warning", fix=fix)


def _place(problem: Diagnostic) -> tuple[str, int, str]:
    return problem.span.path, problem.span.line, problem.name
