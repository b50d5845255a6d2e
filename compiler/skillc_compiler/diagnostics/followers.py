"""Leaves out what only follows from a syntax error: names and members in lines that could not be parsed."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from skillc_compiler.diagnostics.consequences import LOGIC, REASONED, TYPES
from skillc_compiler.program.spans import is_within_lines
from skillc_compiler.program.typed import ParsedFile
from skillc_dsl import syntax as s
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.source import Span

IN_DECLARATION = frozenset(
    {
        "unknown-parameter",
        "unknown-argument",
        "unknown-implementation",
        "unknown-label",
        "missing-argument",
        "empty-block",
        "missing-body",
        "no-implementation",
        "never-ends",
        "no-output",
        "no-effect",
        "not-scoped",
        "out-never-assigned",
        "out-unassigned",
        "unlinked-inference",
        "unset-optional",
        "recursion",
    }
)
UNUSED = frozenset(
    {"unused-use", "unused-prefix", "unused-import", "unused-let", "unused-parameter", "unreachable-skill"}
)
UNKNOWN = frozenset(
    {
        "unknown-class",
        "unknown-type",
        "unknown-relation",
        "unknown-property",
        "unknown-function",
        "unknown-skill",
        "unknown-prefix",
        "no-implementation",
        "unachievable-goal",
    }
)
JUDGED = TYPES | LOGIC | REASONED | {"two-values"}
WORD = re.compile(r"\w+")


def without_followers(
    found: Iterable[Diagnostic], syntax: Sequence[Diagnostic], files: Sequence[ParsedFile]
) -> Iterator[Diagnostic]:
    """Yield the diagnostics that no syntax error explains.

    A syntax error in a declaration explains other problems on its line, unknown and missing names in the declaration,
    in implementations and calls of a broken skill, and everything that depends on types, values and effects in
    declarations that mention it. A syntax error outside any declaration, such as a broken import, explains names
    without a close match, and unused vocabularies in its own file.
    """
    lines = {(problem.span.path, problem.span.line) for problem in syntax}
    broken = tuple(_broken(syntax, files))
    near_broken = (*broken, *_speaking_of(syntax, files))
    orphans = [d for d in syntax if not any(is_within_lines(d.span, known.span) for known in _declarations(files))]
    orphaned = {problem.span.path for problem in orphans if problem.name == "syntax"}
    for problem in found:
        places = (problem.span, *(label.span for label in problem.labels))
        explained = (
            (problem.span.path, problem.span.line) in lines
            or (problem.name in IN_DECLARATION and _in_any(places, broken))
            or (problem.name in JUDGED and _in_any(places, near_broken))
            or (problem.name in UNUSED and bool(syntax))
            or (problem.name in UNKNOWN and bool(orphans) and not problem.help.startswith(("did you mean", "it is in")))
            or (problem.name in UNKNOWN and problem.span.path in orphaned and problem.help.startswith("it is in"))
        )
        if not explained:
            yield problem


def _broken(syntax: Sequence[Diagnostic], files: Sequence[ParsedFile]) -> Iterator[Span]:
    """Yield the spans of declarations with a syntax error, and of the implementations of such skills."""
    broken = _with_errors(syntax, files)
    yield from (declaration.span for declaration in broken)
    skills = {declaration.name.text for declaration in broken if isinstance(declaration, s.SkillDeclaration)}
    for declaration in _declarations(files):
        if isinstance(declaration, s.ImplementationDeclaration) and declaration.skill.text in skills:
            yield declaration.span


def _speaking_of(syntax: Sequence[Diagnostic], files: Sequence[ParsedFile]) -> Iterator[Span]:
    """Yield the spans of the declarations that mention one with a syntax error."""
    names = {declaration.name.text for declaration in _with_errors(syntax, files)}
    if not names:
        return
    for unit in files:
        text = unit.text.split("\n")
        for declaration in unit.file.declarations:
            said = text[declaration.span.line - 1 : declaration.span.end_line]
            if not names.isdisjoint(WORD.findall("\n".join(said))):
                yield declaration.span


def _with_errors(syntax: Sequence[Diagnostic], files: Sequence[ParsedFile]) -> list[s.Declaration]:
    return [
        each for each in _declarations(files) if any(is_within_lines(problem.span, each.span) for problem in syntax)
    ]


def _declarations(files: Sequence[ParsedFile]) -> Iterator[s.Declaration]:
    return (declaration for unit in files for declaration in unit.file.declarations)


def _in_any(places: Sequence[Span], wholes: Sequence[Span]) -> bool:
    return any(is_within_lines(place, whole) for place in places for whole in wholes)
