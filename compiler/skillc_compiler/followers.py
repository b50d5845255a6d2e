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
        "unused-let",
        "unused-parameter",
        "recursion",
    }
)
IN_LIBRARY = frozenset(
    {
        "unknown-class",
        "unknown-type",
        "unknown-relation",
        "unknown-property",
        "unknown-function",
        "unknown-skill",
        "unknown-vocabulary",
        "unknown-prefix",
        "unused-use",
        "unused-prefix",
        "unused-import",
        "no-implementation",
        "unachievable-goal",
    }
)


def without_followers(
    found: Iterable[Diagnostic], syntax: Sequence[Diagnostic], files: Sequence[ReadFile]
) -> Iterator[Diagnostic]:
    """Yield what was found, without what the syntax errors explain.

    An error inside a declaration explains what is unknown or missing in it, in the implementations of a skill so broken
    and in calls of it; one outside any declaration explains names unknown anywhere in the library.
    """
    broken = list(_broken(syntax, files))
    orphaned = any(not any(_inside(d.span, d2.span) for d2 in _declarations(files)) for d in syntax)
    loose = bool(broken) or orphaned
    for problem in found:
        places = (problem.span, *(label.span for label in problem.labels))
        if problem.name in IN_DECLARATION and any(_inside(place, span) for place in places for span in broken):
            continue
        if problem.name in IN_LIBRARY and (orphaned or (loose and problem.name.startswith("unused"))):
            continue
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
