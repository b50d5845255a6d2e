"""Leaves out what only follows from a syntax error: names and members on a line that was not understood."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from skillc_compiler.program import ReadFile
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
        "missing-body",
        "no-implementation",
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
        "no-implementation",
        "unachievable-goal",
    }
)


def without_followers(
    found: Iterable[Diagnostic], syntax: Sequence[Diagnostic], files: Sequence[ReadFile]
) -> Iterator[Diagnostic]:
    """Yield what was found, without what the syntax errors explain.

    An error inside a declaration explains what else is wrong on its line, what is unknown or missing in the
    declaration, in the implementations of a skill so broken and in calls of it. One outside any declaration, such as an
    import of a file that there is not, explains names that are like no known one.
    """
    lines = {(problem.span.path, problem.span.line) for problem in syntax}
    broken = list(_broken(syntax, files))
    orphaned = any(not any(_inside(d.span, known.span) for known in _declarations(files)) for d in syntax)
    for problem in found:
        places = (problem.span, *(label.span for label in problem.labels))
        in_broken = any(_inside(place, span) for place in places for span in broken)
        explained = (
            (problem.span.path, problem.span.line) in lines
            or (problem.name in IN_DECLARATION and in_broken)
            or (problem.name in UNUSED and bool(syntax))
            or (problem.name in UNKNOWN and orphaned and not problem.help.startswith(("did you mean", "it is in")))
        )
        if not explained:
            yield problem


def _broken(syntax: Sequence[Diagnostic], files: Sequence[ReadFile]) -> Iterator[Span]:
    """Yield the spans of declarations with a syntax error, and of the implementations of such skills."""
    skills: set[str] = set()
    for declaration in _declarations(files):
        if any(_inside(problem.span, declaration.span) for problem in syntax):
            yield declaration.span
            if isinstance(declaration, s.SkillDeclaration):
                skills.add(declaration.name.text)
    for declaration in _declarations(files):
        if isinstance(declaration, s.ImplementationDeclaration) and declaration.skill.text in skills:
            yield declaration.span


def _declarations(files: Sequence[ReadFile]) -> Iterator[s.Declaration]:
    return (declaration for unit in files for declaration in unit.file.declarations)


def _inside(place: Span, whole: Span) -> bool:
    return place.path == whole.path and whole.line <= place.line <= whole.end_line
