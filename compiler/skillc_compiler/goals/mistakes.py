"""Checks on the text of a goal or call, for mistakes that the parser would report misleadingly."""

from __future__ import annotations

import difflib
import re
from collections.abc import Callable, Collection, Iterable, Iterator
from typing import Literal

from skillc_dsl.diagnostics import Diagnostic, Fix, Misfit
from skillc_dsl.source import Span

InputKind = Literal["goal", "condition", "call"]

EXAMPLES: dict[InputKind, str] = {
    "goal": "a goal is a condition, such as `lab:Board-1.isClean == true` or `(contain lab:Box-1 lab:Part-1)`",
    "condition": "a condition is, for example, `lab:Board-1.isClean == true` or `(contain lab:Box-1 lab:Part-1)`",
    "call": "a call is `Skill(parameter: value, ..)`",
}
_CALL = re.compile(r"\s*(?:do\s+)?\w+\s*(?:[(\[]|$)")
_PARENTHESIS = re.compile(r"[()]")
_COMMENT = re.compile(r"[#;].*")
MOST_SOUGHT = 20
"""For so many words of a goal a similar name is looked for."""
_BARE = re.compile(r"(?<![\w:.?\"-])[A-Za-z]\w*(?:-\w+)*(?![\w:(\"-])")
_DECLARED = re.compile(r"\b([A-Za-z]\w*+)\s*+:\s")


def find_mistakes(
    text: str, what: InputKind, individuals: Iterable[str], means_something: Callable[[str], bool]
) -> tuple[Diagnostic, ...]:
    """Report an empty text, a call without the form of one, unbalanced parentheses, and names without their prefix.

    `individuals` are the qualified names of the scene's individuals; `means_something` is true for a bare name that
    already has a meaning.
    """
    if not text.strip():
        return (Diagnostic("syntax", Span(what, 1, 1, 1, 2), f"the {what} is empty", EXAMPLES[what]),)
    lines = [_COMMENT.sub("", line) for line in text.split("\n")]
    if what == "call" and not _CALL.match("\n".join(lines)):
        help_ = f"{EXAMPLES['call']}; a condition is given as a goal"
        return (Diagnostic("syntax", Span(what, 1, 1, 1, 2), "this is not a call of a skill", help_),)
    return tuple(_parentheses(lines, what)) or tuple(_prefixes(lines, what, sorted(individuals), means_something))


def reword(problem: Diagnostic, what: InputKind) -> tuple[str, str]:
    """Return the message and help of a syntax error for a goal or call, without mentioning the task that wraps it."""
    if isinstance(problem, Misfit) and problem.could_end:
        return problem.found, EXAMPLES[what]
    return problem.message, problem.help


def _parentheses(lines: list[str], what: InputKind) -> Iterator[Diagnostic]:
    opened: list[Span] = []
    for mark, span in _find(_PARENTHESIS, lines, what):
        if mark == "(":
            opened.append(span)
        elif opened:
            opened.pop()
        else:
            yield Diagnostic("syntax", span, "this `)` closes nothing", "remove it, or add the `(` before it")
    for span in opened:
        yield Diagnostic("syntax", span, "this `(` is not closed: a `)` is missing", "add `)` where it ends")


def _prefixes(
    lines: list[str], what: InputKind, individuals: list[str], means_something: Callable[[str], bool]
) -> Iterator[Diagnostic]:
    local = {name.rpartition(":")[2]: name for name in individuals}
    variables = {name for line in lines for name in _DECLARED.findall(line)}
    sought: dict[str, list[str]] = {}
    for word, span in _find(_BARE, lines, what):
        alike = [word] if word in local else _similar(word, local, sought) if "-" in word else []
        if alike and word not in variables and not means_something(word):
            meant = local[alike[0]]
            fix = Fix(span, meant, f"write `{meant}`")
            yield Diagnostic("missing-prefix", span, f"`{word}` has no prefix", f"write `{meant}`", fix=fix)


def _find(pattern: re.Pattern[str], lines: list[str], what: InputKind) -> Iterator[tuple[str, Span]]:
    """Yield what matches a pattern, with its place."""
    for number, line in enumerate(lines, start=1):
        for found in pattern.finditer(line):
            yield found.group(), Span(what, number, found.start() + 1, number, found.end() + 1)


def _similar(word: str, names: Collection[str], sought: dict[str, list[str]]) -> list[str]:
    """Return the name that is similar to a word, if it is one of the first MOST_SOUGHT words; `sought` keeps these."""
    if word not in sought and len(sought) < MOST_SOUGHT:
        sought[word] = difflib.get_close_matches(word, names, n=1)
    return sought.get(word, [])
